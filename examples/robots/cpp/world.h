#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The sorting table: two grippers, four coloured blocks, three bins; two of the blocks are to be
/// put into bins. What decides is in the picture alone. A gripper reaches three of the four places
/// (the left one not the rightmost, and the other way round), takes no block that another stands
/// on, and puts one block into a bin that has no lid; the left one fills the left and the middle
/// bin, the right one the middle and the right. So a block taken by the wrong gripper has nowhere
/// to go. The same rules, scenes and pictures in Python and Java: ../python/world.py,
/// ../java/World.java.
namespace sorting {

enum Side { kLeft, kRight };
constexpr int kNothing = -1;

/// A row of the action table: a gripper takes a block, or puts what it holds into a bin.
struct Action {
  Side side;
  bool take;
  int thing;
};

inline const std::vector<Action> kActions = {
    {kLeft, true, 0},  {kLeft, true, 1},  {kLeft, true, 2},   {kLeft, true, 3},
    {kRight, true, 0}, {kRight, true, 1}, {kRight, true, 2},  {kRight, true, 3},
    {kLeft, false, 0}, {kLeft, false, 1}, {kRight, false, 1}, {kRight, false, 2}};
inline const std::vector<std::int32_t> kTakes = {0, 1, 2, 3, 4, 5, 6, 7};
inline const std::vector<std::int32_t> kPuts[] = {{8, 9}, {10, 11}};  // of each gripper
inline const std::pair<const char*, const char*> kCauses[] = {
    {"reach", "it stands out of this gripper's reach"},
    {"blocked", "another block stands on it"},
    {"gone", "it was put away before"},
    {"lid", "the lid is on this bin"},
    {"full", "this bin is full"}};
constexpr int kEnough = 2, kPlanLength = 4;  // blocks in bins, each taken and put
constexpr int kPixels = 64;                  // a side of the picture
constexpr int kTicks = 10;  // of an action; the gripper is there after half of them

inline std::string Kind(const Action& action) {
  return std::string(action.side == kLeft ? "left" : "right") + (action.take ? "_take" : "_put");
}

inline std::string Thing(const Action& action) {
  static const char* const kColours[] = {"red", "green", "blue", "yellow"};
  static const char* const kBins[] = {"left_bin", "middle_bin", "right_bin"};
  return action.take ? kColours[action.thing] : kBins[action.thing];
}

/// SplitMix64: the same numbers in every language.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  int Below(int bound) {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return static_cast<int>(((z ^ (z >> 31)) >> 33) % static_cast<std::uint64_t>(bound));
  }

 private:
  std::uint64_t state_;
};

class World {
 public:
  /// A scene: four blocks on three of the places, one of them on another; no bin, one or two with a
  /// lid.
  explicit World(std::uint64_t seed) {
    Dice dice(seed);
    std::array<int, 4> order{0, 1, 2, 3};
    for (int i = 3; i > 0; --i) std::swap(order[i], order[dice.Below(i + 1)]);
    const int first = dice.Below(2), tall = dice.Below(3), lids = dice.Below(5),
              odd = dice.Below(3);
    for (int i = 0; i < 3; ++i) places_[first + i].push_back(order[i]);
    places_[first + tall].push_back(order[3]);
    // In one scene of five two bins are closed, and two blocks have no room; in two of five one is.
    for (int i = 0; i < 3; ++i) lids_[i] = lids == 0 ? i != odd : lids < 3 && i == odd;
  }

  /// Why an action of the table cannot be begun at all; empty: it can.
  std::string Refusal(int action) const {
    if (action < 0 || action >= static_cast<int>(kActions.size())) return "there is no such action";
    if (!cause_.empty() || done()) return "the episode is over";
    const Action& a = kActions[action];
    if (a.take && (hands_[0] != kNothing || hands_[1] != kNothing))
      return "a gripper holds a block";
    if (!a.take && hands_[a.side] == kNothing) return "this gripper holds no block";
    return "";
  }

  void Begin(int action) {
    action_ = &kActions[action];
    tick_ = 0;
    goal_ = Goal();
  }
  void Stop() { action_ = nullptr; }

  /// One step of the action that was begun. @return false once it is over: see cause()
  bool Tick() {
    if (++tick_ == kTicks / 2) {
      cause_ = Defect();
      if (!cause_.empty()) return false;  // the gripper stays where it failed
      Move();
    }
    if (tick_ == kTicks) action_ = nullptr;
    return action_ != nullptr;
  }

  const std::string& cause() const { return cause_; }  ///< of the failure; empty: none
  bool done() const { return put_away_ == kEnough; }

  /// 64x64 pixels, three bytes each.
  std::vector<std::uint8_t> Picture() const {
    std::vector<std::uint8_t> pixels;
    Fill(&pixels, 0, 0, kPixels, kPixels, kFloor);
    Fill(&pixels, 0, 28, kPixels, 4, cause_.empty() ? kTable : kAlarm);
    for (int i = 0; i < 4; ++i)
      for (int level = 0; level < static_cast<int>(places_[i].size()); ++level)
        Fill(&pixels, 16 * i + 1, 14 * (1 - level), 14, 14, kPaint[places_[i][level]]);
    for (int i = 0; i < 3; ++i) {
      Fill(&pixels, 4 + 20 * i, 48, 16, 16, kWall);
      const Colour& inside = bins_[i] == kNothing ? kFloor : kPaint[bins_[i]];
      Fill(&pixels, 6 + 20 * i, 48, 12, 14, lids_[i] ? kLid : inside);
    }
    for (const Side side : {kLeft, kRight}) DrawGripper(&pixels, side);
    return pixels;
  }

 private:
  using Colour = std::array<std::uint8_t, 3>;
  struct Point {
    int x, y;
  };
  static constexpr Colour kPaint[] = {{230, 40, 40}, {40, 200, 60}, {50, 90, 240}, {240, 220, 40}};
  static constexpr Colour kFloor{30, 30, 30}, kTable{90, 90, 90}, kAlarm{255, 140, 0},
      kGripper{255, 255, 255}, kLid{235, 235, 235}, kWall{0, 190, 190};
  static constexpr Point kHome[] = {{8, 34}, {40, 34}};

  static void Fill(std::vector<std::uint8_t>* pixels, int x, int y, int width, int height,
                   const Colour& colour) {
    pixels->resize(3 * kPixels * kPixels);
    for (int row = std::max(y, 0); row < std::min(y + height, kPixels); ++row)
      for (int column = std::max(x, 0); column < std::min(x + width, kPixels); ++column)
        std::copy(colour.begin(), colour.end(), pixels->begin() + 3 * (row * kPixels + column));
  }

  void DrawGripper(std::vector<std::uint8_t>* pixels, Side side) const {
    Point at = kHome[side];
    if (action_ && action_->side == side) {
      const int way = cause_.empty() ? std::min(tick_, kTicks - tick_) : tick_;
      at.x += Share(goal_.x - at.x, way);
      at.y += Share(goal_.y - at.y, way);
    }
    Fill(pixels, at.x, at.y - 2, 16, 4, kGripper);
    if (hands_[side] != kNothing) Fill(pixels, at.x + 1, at.y + 2, 14, 10, kPaint[hands_[side]]);
  }

  // Rounded down, below zero too.
  static int Share(int distance, int way) {
    const int steps = distance * way * 2;
    return steps / kTicks - (steps % kTicks < 0 ? 1 : 0);
  }

  int PlaceOf(int block) const {
    for (int i = 0; i < 4; ++i)
      if (std::count(places_[i].begin(), places_[i].end(), block) > 0) return i;
    return kNothing;
  }

  std::string Defect() const {
    const int thing = action_->thing;
    if (!action_->take) return lids_[thing] ? "lid" : bins_[thing] != kNothing ? "full" : "";
    const int place = PlaceOf(thing);
    if (place == kNothing) return "gone";
    if (place == (action_->side == kLeft ? 3 : 0)) return "reach";
    return places_[place].back() == thing ? "" : "blocked";
  }

  void Move() {
    int& hand = hands_[action_->side];
    if (action_->take) {
      hand = action_->thing;
      places_[PlaceOf(hand)].pop_back();
    } else {
      std::swap(bins_[action_->thing], hand);
      ++put_away_;
    }
  }

  // Corner of the gripper's picture where it acts, or as near as it comes.
  Point Goal() const {
    if (!action_->take) return {4 + 20 * action_->thing, 44};
    const int place = PlaceOf(action_->thing);
    if (place == kNothing) return kHome[action_->side];
    const int x = action_->side == kLeft ? std::min(16 * place, 32) : std::max(16 * place, 16);
    return {x, places_[place].front() == action_->thing ? 16 : 2};
  }

  std::array<std::vector<int>, 4> places_;  // blocks of each place, from below
  std::array<bool, 3> lids_{};
  std::array<int, 3> bins_{kNothing, kNothing, kNothing};
  std::array<int, 2> hands_{kNothing, kNothing};
  const Action* action_ = nullptr;  // under way, or where it failed
  Point goal_{};
  int tick_ = 0, put_away_ = 0;
  std::string cause_;
};

}  // namespace sorting
