#include "services/predict/prediction.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "services/binding/task_messages.h"
#include "services/executive/preparation.h"
#include "services/predict/gesture_watch.h"
#include "services/predict/picture_question.h"

namespace prospect::services {
namespace {

using planner::Path;
using Segment = GestureWatch::Segment;

ExecutiveOptions ServicesOnly(const cli::PredictOptions& options) {
  ExecutiveOptions wanted;
  wanted.workers = 0;  // nothing is searched
  wanted.services_timeout_ms = options.services_timeout_ms;
  wanted.scene_timeout_ms = options.picture_timeout_ms;
  wanted.reset = false;
  return wanted;
}

std::string WordsOf(const task_t& task, int action) {
  const action_t& row = task.actions[static_cast<std::size_t>(action)];
  std::string words = row.name;
  if (row.kind != row.name) words += " " + row.kind;
  if (!row.object.empty() && row.name.find(row.object) == std::string::npos) {
    words += " (" + row.object + ")";
  }
  return words;
}

std::string WordsOf(const task_t& task, const Path& path) {
  std::string words;
  for (const int action : path) words += (words.empty() ? "" : ", then ") + WordsOf(task, action);
  return words;
}

int ActionNamed(const task_t& task, const std::string& name) {
  std::string known;
  for (const action_t& action : task.actions) {
    if (action.name == name) return action.index;
    known += (known.empty() ? "" : ", ") + action.name;
  }
  throw ExitError(kExitUsage, "--actions: TASK has no '" + name + "'; it has " + known);
}

/// One after another: the pictures of all beginnings of the list.
std::vector<Path> NamedPaths(const task_t& task, const std::string& names) {
  std::vector<Path> paths;
  Path path;
  std::istringstream in(names);
  for (std::string name; std::getline(in, name, ',');) {
    path.push_back(static_cast<std::uint8_t>(ActionNamed(task, name)));
    paths.push_back(path);
  }
  return paths;
}

class Prediction {
 public:
  Prediction(Conversation& talk, const cli::PredictOptions& options)
      : talk_(talk), options_(options), inbox_(talk), watch_(talk) {}

  report::FuturesSheet Run() {
    const ExecutiveOptions wanted = ServicesOnly(options_);
    if (options_.seed >= 0) talk_.view().FollowSeed(options_.seed);  // from its first picture on
    AwaitServices(talk_, wanted);
    const model_info_t server = ChooseModel(talk_, wanted);
    AwaitPicture(wanted);
    Look();
    ChoosePaths();
    const auto pictures =
        AskForPictures(talk_, &inbox_, server, {*first_, present_, executed_, paths_});
    if (pictures.empty()) {
      throw ExitError(kExitServiceLost, "no predicted picture came; see the model server's log");
    }
    const std::map<Path, agent::Picture> truths =
        options_.truth > 0 ? AwaitTruth() : std::map<Path, agent::Picture>();
    return SheetOf(pictures, truths);
  }

 private:
  const BusView& view() const { return talk_.view(); }

  void AwaitPicture(const ExecutiveOptions& wanted) {
    if (options_.seed < 0) return PrepareScene(talk_, wanted);
    const auto there = [this] { return view().latest().has_value(); };
    if (talk_.Until(there, options_.picture_timeout_ms)) return;
    throw ExitError(kExitTimeout, "no picture of scene " + std::to_string(options_.seed) +
                                      " in time: does it run?");
  }

  /// The picture to start from, and what is under way in it.
  void Look() {
    first_ = Oldest();
    if (options_.from_start || options_.segment > 0) {
      AwaitBeginning();
    } else {
      // A label comes with its picture; without one within a moment nobody says labels here.
      talk_.Until([this] { return watch_.heard_any(); }, kLabelMs);
      now_ = watch_.Latest();
      present_ = *view().latest();
    }
  }

  observation_t Oldest() const {
    const auto& frames = view().frames();
    observation_t oldest = *view().latest();
    if (!frames.empty()) TakePicture(frames.begin()->second, frames.begin()->first, &oldest);
    return oldest;
  }

  static void TakePicture(const agent::Picture& picture, std::int64_t frame,
                          observation_t* observation) {
    observation->frame = frame;
    observation->data = picture.rgb;
  }

  void AwaitBeginning() {
    talk_.Until([this] { return watch_.heard_any(); }, kLabelMs);
    const std::optional<Segment> before = watch_.Latest();
    const std::int64_t episode = view().episode_id();
    const auto begun = [&] {
      // A video that begins again.
      if (watch_.elsewhere() && options_.seed < 0) talk_.view().FollowAny();
      now_ = watch_.Find(options_.segment);
      if (!now_ || options_.from_start) now_ = watch_.Latest();
      if (!now_ || now_->number < options_.segment) return false;
      if (!view().frames().contains(now_->frame)) return false;
      const bool same = before && view().episode_id() == episode && now_->number == before->number;
      return !(options_.from_start && same);
    };
    if (!talk_.Until(begun, options_.picture_timeout_ms)) {
      throw ExitError(kExitTimeout, "no action began in time: does somebody say LABEL here?");
    }
    present_ = *view().latest();
    TakePicture(view().frames().at(now_->frame), now_->frame, &present_);
    first_ = Oldest();
  }

  void ChoosePaths() {
    const task_t& task = *view().task();
    const planner::TaskRules rules = RulesFromTask(task);
    if (now_ && now_->previous < task.num_actions) {
      executed_ = {static_cast<std::uint8_t>(now_->previous)};
    }
    if (!options_.actions.empty()) {
      paths_ = NamedPaths(task, options_.actions);
      RequireAllowed(rules, paths_.back());
      return;
    }
    const std::vector<int> firsts =
        now_ ? std::vector<int>{now_->action} : rules.AllowedActions(executed_, {});
    for (const int action : firsts) {
      const Path path = {static_cast<std::uint8_t>(action)};
      paths_.push_back(path);
      if (!now_) continue;
      for (const int next : rules.AllowedActions(executed_, path)) {
        paths_.push_back({path[0], static_cast<std::uint8_t>(next)});
      }
    }
  }

  void RequireAllowed(const planner::TaskRules& rules, const Path& path) const {
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Path before(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(k));
      if (rules.Allowed(executed_, before, path[k])) continue;
      throw ExitError(kExitUsage, "--actions: the task does not allow " +
                                      WordsOf(*view().task(), path[k]) + " there");
    }
  }

  /// What the camera saw where the action under way ended, and the one after it.
  std::map<Path, agent::Picture> AwaitTruth() {
    std::map<Path, agent::Picture> truths;
    if (!now_) return truths;
    const auto known = [this] { return Ending(now_->number + 1) || watch_.over(); };
    talk_.Until(known, static_cast<std::int64_t>(1000 * options_.truth));
    Path path;
    for (int k = 0; k < 2; ++k) {
      const auto segment = watch_.Find(now_->number + k);
      const auto frame = Ending(now_->number + k);
      if (!segment || !frame) break;
      path.push_back(static_cast<std::uint8_t>(segment->action));
      truths[path] = view().frames().at(*frame);
    }
    return truths;
  }

  /// The frame on which segment `number` ended: the next one's first, or the trial's last. Nothing
  /// until it is known and seen.
  std::optional<std::int64_t> Ending(int number) const {
    const auto next = watch_.Find(number + 1);
    std::optional<std::int64_t> frame;
    if (next) frame = next->frame;
    if (!next && watch_.over() && watch_.Find(number)) frame = watch_.last_frame();
    if (!frame || !view().frames().contains(*frame)) return std::nullopt;
    return frame;
  }

  report::FuturesSheet SheetOf(const std::map<Path, agent::Picture>& pictures,
                               const std::map<Path, agent::Picture>& truths) const {
    const task_t& task = *view().task();
    report::FuturesSheet sheet;
    sheet.title = "What comes next: " + task.name + " (" + task.world_version + ")";
    sheet.seen = PictureOf(present_);
    for (const Path& path : paths_) {
      const auto found = pictures.find(path);
      if (found == pictures.end()) continue;
      const auto truth = truths.find(path);
      sheet.futures.push_back({WordsOf(task, path), found->second,
                               truth == truths.end() ? agent::Picture() : truth->second});
    }
    sheet.caption = "Seen: frame " + std::to_string(present_.frame) + " of episode " +
                    std::to_string(present_.episode_id) +
                    ". The other pictures are imagined by the networks from that one alone";
    sheet.caption += truths.empty()
                         ? "."
                         : ", but for those named 'what then came': the camera's own, taken when "
                           "the action had ended. MAE: mean absolute error as a share of full "
                           "range; beside it that of what was seen.";
    return sheet;
  }

  static constexpr std::int64_t kLabelMs = 1500;

  Conversation& talk_;
  const cli::PredictOptions& options_;
  PredictionInbox inbox_;
  GestureWatch watch_;
  std::optional<observation_t> first_;
  observation_t present_{};
  std::optional<Segment> now_;
  Path executed_;
  std::vector<Path> paths_;
};

}  // namespace

report::FuturesSheet Predict(Conversation& talk, const cli::PredictOptions& options) {
  return Prediction(talk, options).Run();
}

}  // namespace prospect::services
