#include "services/executive/bus_mind.h"

#include "base/hash.h"
#include "services/binding/search_messages.h"
#include "services/executive/preparation.h"

namespace prospect::services {

BusMind::BusMind(Conversation& talk, const ExecutiveOptions& options)
    : talk_(talk), options_(options), session_(talk), predictions_(talk), familiarity_(talk) {}

agent::MindInfo BusMind::Choose() {
  model_ = ChooseModel(talk_, options_);
  return {model_.engine, base::HexText(model_.weights_hash), model_.refusal_threshold};
}

std::vector<model::CalibrationSample> BusMind::Calibrations(bool needed) {
  return AwaitCalibrations(talk_, model_, needed);
}

// A picture is named by episode and frame: the same name is the same picture in every search of the
// episode.
search_image_t BusMind::ImageOf(const agent::Glimpse& glimpse) const {
  search_image_t image{};
  image.image_id =
      ((talk_.view().episode_id() & 0x7fffffffffLL) << 24) | (glimpse.frame & 0xffffff);
  image.encoding = observation_t::ENCODING_RGB8;
  image.width = glimpse.picture.width;
  image.height = glimpse.picture.height;
  image.data = glimpse.picture.rgb;
  image.num_bytes = static_cast<std::int32_t>(image.data.size());
  return image;
}

SearchQuestion BusMind::ToRoot(const agent::SearchQuestion& asked) const {
  const task_t& task = *talk_.view().task();
  SearchQuestion question;
  question.first = ImageOf(asked.first);
  question.present = ImageOf(asked.present);
  question.budget_ms = options_.budget_ms;
  question.samples = asked.parameters.samples;
  auto& root = question.root;
  root.weights_hash = model_.weights_hash;
  root.task_hash = task.task_hash;
  root.task = task.name;
  root.episode_id = talk_.view().episode_id();
  root.image0_id = question.first.image_id;
  root.image_id = question.present.image_id;
  root.executed = asked.executed;
  root.num_executed = static_cast<std::int32_t>(root.executed.size());
  root.plan_length = asked.rules.plan_length;
  root.time_left = -1;
  root.goals = asked.goal;
  root.num_goals = static_cast<std::int32_t>(root.goals.size());
  root.leaves = options_.leaves;
  SetParameters(asked.parameters, &root);
  return question;
}

agent::SearchAnswer BusMind::Search(const agent::SearchQuestion& question) {
  return session_.Search(ToRoot(question));
}

std::map<planner::Path, planner::Evaluation> BusMind::Judge(
    const std::vector<planner::Path>& paths) {
  return session_.Evaluate(paths);
}

std::map<planner::Path, agent::Picture> BusMind::Imagine(const std::vector<planner::Path>& paths) {
  return predictions_.Fetch(session_.root(), paths);
}

agent::Recognition BusMind::Familiar() { return familiarity_.Ask(session_.root()); }

}  // namespace prospect::services
