#include "sim/suturing/gesture_player.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "sim/suturing/gestures.h"
#include "sim/suturing/needle.h"

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kPatience = 1.5;    // s a phase may take longer than planned
constexpr double kLyingTime = 0.8;   // s after which a lost needle ends the gesture
constexpr double kLooser = 16e-3;    // m/s at which thread is let out
constexpr double kTailLeft = 12e-3;  // m of the thread's end that sticks out of the first stitch

Vector3d Tail(const SuturingParameters& p, const SuturingWorld& world) {
  return world.needle() * NeedlePoint(p, M_PI);
}

Vector3d Tip(const SuturingParameters& p, const SuturingWorld& world) {
  return world.needle() * NeedlePoint(p, 0);
}

// The hand's unrest: slow sway and a little tremor.
Vector3d Unrest(double time, int hand, double size) {
  const double a = 2 * M_PI * time + 2.1 * hand;
  return size * Vector3d(std::sin(0.71 * a) + 0.3 * std::sin(8.3 * a), std::sin(0.53 * a + 1),
                         std::sin(0.61 * a + 2) + 0.3 * std::sin(9.1 * a + 1));
}

}  // namespace

void GesturePlayer::Rest(const SuturingWorld& world) {
  *this = GesturePlayer();
  Stop(world);
}

void GesturePlayer::Stop(const SuturingWorld& world) {
  running_ = false;
  for (int i = 0; i < 2; ++i) {
    HandMove move;
    move.from = move.to = world.hand(i);
    move.opening = world.opening(i);
    phase_.hands[i] = move;
  }
  phase_.thread = ThreadRule::kKeep;
  phase_.seconds = elapsed_ = 1;
}

void GesturePlayer::Begin(int gesture, std::uint64_t seed, const SuturingWorld& world,
                          Suture* suture, const SuturingParameters& p, const SurgeonStyle& style) {
  gesture_ = gesture;
  index_ = -1;
  seed_ = seed;
  running_ = true;
  total_ = 0;
  lost_ = -1;
  failure_.clear();
  began_in_tissue_ = suture->in_tissue();
  suture->thread.in_right = false;
  base::Random random(base::MixSeeds({seed, 0x736c6970ULL}));
  const bool slips = random.Uniform() < p.slip;
  lose_at_ = slips ? random.Uniform(0.3, 2.5) : -1;
  NextPhase(world, *suture, p, style);
}

bool GesturePlayer::NextPhase(const SuturingWorld& world, const Suture& suture,
                              const SuturingParameters& p, const SurgeonStyle& style) {
  std::array<HandMove, 2> last = phase_.hands;
  for (int i = 0; i < 2; ++i) last[i].to = phase_.hands[i].At(elapsed_ / phase_.seconds);
  ++index_;
  const base::Random random(base::MixSeeds({seed_, static_cast<std::uint64_t>(index_)}));
  const std::optional<Phase> next =
      PlanPhase(gesture_, index_, {world, suture, last, began_in_tissue_}, p, style, random);
  if (!next) return false;
  phase_ = *next;
  elapsed_ = 0;
  feed_before_ = suture.thread.feed;
  end_before_ = suture.thread.end;
  return true;
}

bool GesturePlayer::Control(SuturingWorld* world, Suture* suture, const SuturingParameters& p,
                            const SurgeonStyle& style) {
  clock_ += p.step;
  elapsed_ += p.step;
  total_ += running_ ? p.step : 0;
  Steer(world, p);
  PullThread(*world, suture, p);
  if (!running_) return false;
  MaybeLose(world, *suture, p);
  if (lost_ > kLyingTime) return Fail("dropped(needle)", *world);
  if (total_ > p.gesture_limit) return Fail("time", *world);
  if (lost_ >= 0 || elapsed_ < phase_.seconds) return true;
  if (!Arrived(*world, p) && elapsed_ < phase_.seconds + kPatience) return true;
  Happen(world, suture, p);
  if (!failure_.empty()) return Fail(failure_, *world);
  if (NextPhase(*world, *suture, p, style)) return true;
  if (gesture_ == kPush && suture->misplaced) return Fail("missed(entry)", *world);
  running_ = false;
  return false;
}

void GesturePlayer::Steer(SuturingWorld* world, const SuturingParameters& p) const {
  for (int i = 0; i < 2; ++i) {
    const HandMove& move = phase_.hands[i];
    Isometry3d target = move.At(elapsed_ / phase_.seconds);
    target.translation() += Unrest(clock_, i, p.tremor);
    world->Steer(i, target, move.opening);
  }
}

bool GesturePlayer::Arrived(const SuturingWorld& world, const SuturingParameters& p) const {
  for (int i = 0; i < 2; ++i) {
    const Isometry3d target = phase_.hands[i].At(1);
    const Isometry3d hand = world.hand(i);
    if ((hand.translation() - target.translation()).norm() > p.tolerance) return false;
    const Eigen::AngleAxisd error(target.linear() * hand.linear().transpose());
    if (std::abs(error.angle()) > p.turn_tolerance) return false;
    if (std::abs(world.opening(i) - phase_.hands[i].opening) > 1e-6) return false;
  }
  return true;
}

void GesturePlayer::Happen(SuturingWorld* world, Suture* suture, const SuturingParameters& p) {
  SuturingThread& thread = suture->thread;
  switch (phase_.event) {
    case PhaseEvent::kNone:
      return;
    case PhaseEvent::kRightTakes:
      return Take(kRightHand, world, p);
    case PhaseEvent::kLeftTakes:
      return Take(kLeftHand, world, p);
    case PhaseEvent::kLetGo:
      return world->Hold(kNoHand);
    case PhaseEvent::kEnters: {
      if (thread.entered) return;  // a push that was given up goes on
      const Vector3d tip = Tip(p, *world), middle = world->needle().translation();
      thread.entered = true;
      suture->misplaced = (tip - EntryDot(p, thread.passed)).norm() > p.dot_tolerance;
      thread.stitches[thread.passed] = {Vector3d(tip.x(), tip.y(), 0),
                                        Vector3d(2 * middle.x() - tip.x(), tip.y(), 0)};
      return;
    }
    case PhaseEvent::kPasses: {
      const Vector3d before = thread.Anchor();
      const double straight = (thread.stitches[thread.passed].entry - before).norm();
      thread.feed = std::max(1e-3, thread.length - straight);
      ++thread.passed;
      thread.side = -thread.side;
      thread.entered = false;
      return thread.Reach(Tail(p, *world), Vector3d::Zero(), true);
    }
    case PhaseEvent::kRightTakesThread:
      thread.in_right = true;
      thread.length = 0;
      return thread.Reach(Tail(p, *world), world->hand(kRightHand).translation(), true);
  }
}

void GesturePlayer::Take(int hand, SuturingWorld* world, const SuturingParameters& p) {
  const Vector3d jaws = world->hand(hand).translation();
  if (DistanceToWire(p, world->needle(), jaws) > p.reach) {
    failure_ = "missed(needle)";
    return;
  }
  world->Hold(hand);
}

void GesturePlayer::PullThread(const SuturingWorld& world, Suture* suture,
                               const SuturingParameters& p) const {
  SuturingThread& thread = suture->thread;
  const bool tightens = running_ && phase_.thread == ThreadRule::kTighten;
  if (running_ && phase_.thread == ThreadRule::kLoosen) thread.length += kLooser * p.step;
  thread.Reach(Tail(p, world), world.hand(kRightHand).translation(), tightens);
  if (!tightens) return;
  const double left = 1 - MinimumJerk(elapsed_ / phase_.seconds);
  thread.feed = feed_before_ * left;
  if (thread.passed != 1) return;
  const Vector3d entry = thread.stitches[0].entry;  // the thread's end is drawn in
  const double before = (end_before_ - entry).norm();
  const double out = std::min(before, kTailLeft);
  thread.end = entry + (end_before_ - entry) * ((out + (before - out) * left) / before);
}

void GesturePlayer::MaybeLose(SuturingWorld* world, const Suture& suture,
                              const SuturingParameters& p) {
  if (lost_ >= 0) lost_ += p.step;
  if (lose_at_ < 0 || total_ < lose_at_ || lost_ >= 0) return;
  lose_at_ = -1;
  if (world->holder() == kNoHand || suture.in_tissue()) return;
  world->Hold(kNoHand);
  lost_ = 0;
}

bool GesturePlayer::Fail(const std::string& why, const SuturingWorld& world) {
  Stop(world);
  failure_ = why;
  return false;
}

}  // namespace prospect::sim
