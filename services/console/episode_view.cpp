#include "services/console/episode_view.h"

#include "model/surprise.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

constexpr std::size_t kMostActs = 256;

const char* StateText(std::int8_t state) {
  static const char* const names[] = {"unknown", "idle",      "running", "succeeded",
                                      "failed",  "cancelled", "refused", "ended"};
  return state >= 0 && state <= action_status_t::STATE_ENDED ? names[state] : "unknown";
}

const char* OutcomeText(std::int8_t outcome) {
  static const char* const names[] = {"unknown", "running", "success", "failure"};
  return outcome >= 0 && outcome <= label_t::OUTCOME_FAILURE ? names[outcome] : "unknown";
}

json PathJson(const planner::Path& path) {
  json ids = json::array();
  for (const auto action : path) ids.push_back(action);
  return ids;
}

}  // namespace

bool EpisodeView::running() const {
  return status_ && status_->state == action_status_t::STATE_RUNNING;
}

void EpisodeView::Begin(std::int64_t episode_id) {
  id_ = episode_id;
  frame_ = -1;
  status_.reset();
  plan_.reset();
  first_plan_.reset();
  acts_.clear();
  searches_.clear();
  acts_before_search_ = 0;
  end_frame_ = -1;
  executive_ = 0;
  outcome_.clear();
  refused_ = false;
  ++revision_;
}

void EpisodeView::Hear(const observation_t& observation) {
  if (observation.episode_id != id_) Begin(observation.episode_id);
  if (observation.frame == frame_ || observation.encoding != observation_t::ENCODING_RGB8) return;
  frame_ = observation.frame;
  picture_utime_ = observation.utime;
  ++pictures_;
  camera_ = std::make_shared<const Picture>(
      Picture{observation.width, observation.height, observation.data});
  SeeEnd();
}

// The picture of an action's end: the one that its status names, which may come before it or after.
void EpisodeView::SeeEnd() {
  if (end_frame_ < 0 || frame_ < end_frame_ || acts_.empty() || !camera_) return;
  acts_.back().seen = camera_;
  end_frame_ = -1;
  ++revision_;
}

void EpisodeView::Finish(Act* act, const action_status_t& status) {
  act->state = status.state;
  act->reason = status.reason;
  end_frame_ = status.frame;
  SeeEnd();
}

void EpisodeView::Hear(const action_status_t& status) {
  if (status.episode_id != id_) return;
  const bool news =
      !status_ || status_->state != status.state || status_->command_id != status.command_id ||
      status_->executive_id != status.executive_id || status_->outcome != status.outcome ||
      status_->reason != status.reason || status_->holder_id != status.holder_id;
  status_ = status;
  if (!news) return;
  ++revision_;
  const bool open = !acts_.empty() && acts_.back().state == action_status_t::STATE_RUNNING;
  const bool same = !acts_.empty() && acts_.back().command_id == status.command_id;
  const bool ended = status.state == action_status_t::STATE_SUCCEEDED ||
                     status.state == action_status_t::STATE_FAILED ||
                     status.state == action_status_t::STATE_CANCELLED ||
                     status.state == action_status_t::STATE_ENDED;
  // A cancel has a command id of its own.
  if (open && ended && (same || status.state == action_status_t::STATE_CANCELLED))
    return Finish(&acts_.back(), status);
  const bool begins = status.state == action_status_t::STATE_RUNNING ||
                      (ended && status.state != action_status_t::STATE_CANCELLED);
  if (same || !begins || status.action < 0 || acts_.size() >= kMostActs) return;
  Act act;
  act.command_id = status.command_id;
  act.action = status.action;
  if (!searches_.empty()) act.search_id = searches_.back();
  for (std::size_t i = acts_before_search_; i < acts_.size(); ++i)
    act.path.push_back(static_cast<std::uint8_t>(acts_[i].action));
  act.path.push_back(static_cast<std::uint8_t>(status.action));
  acts_.push_back(act);
  if (ended) Finish(&acts_.back(), status);
}

void EpisodeView::Hear(const verdict_t& verdict) {
  if (verdict.episode_id != id_) return;
  for (Act& act : acts_) {
    if (act.command_id != verdict.command_id || act.state != action_status_t::STATE_ENDED) continue;
    act.state =
        verdict.succeeded ? action_status_t::STATE_SUCCEEDED : action_status_t::STATE_FAILED;
    ++revision_;
  }
}

void EpisodeView::Hear(const plan_t& plan) {
  if (plan.episode_id != id_) return;
  if (!first_plan_) first_plan_ = plan;
  plan_ = plan;
  refused_ = plan.decision == plan_t::DECISION_REFUSE;
  executive_ = plan.executive_id;
  ++revision_;
}

void EpisodeView::Hear(const search_root_t& root, std::int64_t) {
  if (root.episode_id != id_) return;
  if (!searches_.empty() && searches_.back() == root.search_id) return;
  if (searches_.size() >= kMostActs) return;
  searches_.push_back(root.search_id);
  executive_ = root.executive_id;
  acts_before_search_ = acts_.size();
  outcome_.clear();
  refused_ = false;
  ++revision_;
}

void EpisodeView::Hear(const health_t& health) {
  if (health.service != "executive" || health.state != health_t::STATE_DRAINING) return;
  if (health.instance_id != executive_ || outcome_ == health.message) return;
  outcome_ = health.message;
  ++revision_;
}

void EpisodeView::TakePicture(const std::string& key, const Picture& picture) {
  for (Act& act : acts_) {
    if (!act.seen || act.surprise >= 0 || PictureKey(act.search_id, act.path) != key) continue;
    if (act.seen->width != picture.width || act.seen->height != picture.height) continue;
    act.surprise = model::Surprise(picture.rgb, act.seen->rgb, picture.width, picture.height);
    ++revision_;
  }
}

json EpisodeView::ToJson() const {
  json acts = json::array(), searches = json::array();
  for (const Act& act : acts_) {
    acts.push_back({{"action", act.action},
                    {"state", StateText(act.state)},
                    {"reason", act.reason},
                    {"search", std::to_string(act.search_id)},
                    {"path", PathJson(act.path)},
                    {"seen", act.seen != nullptr},
                    {"surprise", act.surprise < 0 ? json() : json(act.surprise)}});
  }
  for (const auto id : searches_) searches.push_back(std::to_string(id));
  json plan;
  if (plan_) {
    json steps = json::array();
    for (const auto& step : plan_->steps)
      steps.push_back(
          {{"action", step.action}, {"score", step.score}, {"predicted", step.predicted != 0}});
    plan = {{"search", std::to_string(plan_->search_id)},
            {"refused", refused_},
            {"reason", plan_->reason},
            {"score", plan_->score},
            {"rollouts", plan_->rollouts},
            {"steps", steps}};
  }
  json first;
  if (first_plan_) {
    json path = json::array();
    for (const auto& step : first_plan_->steps) path.push_back(step.action);
    first = {{"search", std::to_string(first_plan_->search_id)}, {"path", path}};
  }
  json status;
  if (status_) {
    status = {{"state", StateText(status_->state)},
              {"action", status_->action},
              {"reason", status_->reason},
              {"outcome", OutcomeText(status_->outcome)},
              {"held", status_->holder_id != 0},
              {"seconds", 1e-6 * static_cast<double>(status_->sim_time_us)}};
  }
  return {{"id", std::to_string(id_)},
          {"frame", frame_},
          {"status", status},
          {"plan", plan},
          {"first", first},
          {"acts", acts},
          {"searches", searches},
          {"outcome", outcome_},
          {"surprising", model::kSurprising}};
}

}  // namespace prospect::services::console
