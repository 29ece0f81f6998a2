#include "lcmtypes/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "lcmtypes/checked_codec.h"

namespace prospect::messages {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kHuge = std::numeric_limits<std::int64_t>::max();

observation_t Picture() {
  observation_t m{};
  m.encoding = observation_t::ENCODING_RGB8;
  m.width = 4;
  m.height = 2;
  m.data.resize(24);
  SetCounts(m);
  return m;
}

search_root_t Root() {
  search_root_t m{};
  m.rule = "paper";
  m.plan_length = 3;
  m.depth = 3;
  m.samples = 100;
  m.leaves = 1;
  m.parameter_names = {"c"};
  m.parameter_values = {10};
  SetCounts(m);
  return m;
}

task_t Task() {
  task_t m{};
  m.name = "navigation";
  m.actions = {{0, "a", "a", "x", 1, {1}}, {1, "b", "b", "y", 1, {0}}};
  m.initial = {0, 1};
  m.plan_length = 2;
  m.image_width = m.image_height = 64;
  m.tick_seconds = 0.1;
  m.action_time_limit = 10;
  m.causes = {{"time", "it ran out of time"}};
  SetCounts(m);
  return m;
}

search_statistics_t Statistics() {
  search_statistics_t m{};
  m.rows = {0, 0x20, 3, 1, 5};
  SetCounts(m);
  return m;
}

expand_reply_t Reply() {
  expand_reply_t m{};
  m.status = expand_reply_t::STATUS_OK;
  m.evaluations.resize(1);
  m.evaluations[0].value = 0.5f;
  m.evaluations[0].done = 1;
  m.evaluations[0].actions = {0, 3};
  m.evaluations[0].q = {1, -1};
  m.evaluations[0].p = {1, 1};
  SetCounts(m);
  return m;
}

label_t Label() {
  label_t m{};
  m.action = m.previous_action = 2;
  m.segment = -1;
  m.outcome = label_t::OUTCOME_RUNNING;
  m.light = 1;
  m.present = {1, 0};
  SetCounts(m);
  return m;
}

// One way to spoil a sound message, and the reason it must be refused for.
template <class T>
struct Fault {
  std::string reason;
  std::function<void(T&)> spoil;
};

template <class T>
void ExpectFaults(const T& sound, const std::vector<Fault<T>>& faults) {
  EXPECT_EQ(Validate(sound), "");
  for (const Fault<T>& fault : faults) {
    T message = sound;
    fault.spoil(message);
    EXPECT_EQ(Validate(message), "value " + fault.reason);
  }
}

TEST(Validate, Observation) {
  const std::string size = "data: wrong picture size";
  ExpectFaults<observation_t>(Picture(),
                              {{"frame: negative", [](auto& m) { m.frame = -1; }},
                               {"encoding: unknown", [](auto& m) { m.encoding = 9; }},
                               {size, [](auto& m) { m.width = 5; }},
                               {size, [](auto& m) { m.width = m.height = 0; }},
                               {size, [](auto& m) { m.width = -4, m.height = -2; }},
                               {size, [](auto& m) { m.width = 1 << 30, m.height = 4; }}});
}

TEST(Validate, SearchRoot) {
  ExpectFaults<search_root_t>(
      Root(), {{"plan_length: out of range", [](auto& m) { m.plan_length = 0; }},
               {"plan_length: out of range", [](auto& m) { m.plan_length = 65; }},
               {"time_left: not finite", [](auto& m) { m.time_left = kNan; }},
               {"rule: empty", [](auto& m) { m.rule = ""; }},
               {"parameter_values: not finite", [](auto& m) { m.parameter_values[0] = kNan; }},
               {"depth: out of range", [](auto& m) { m.depth = 65; }},
               {"samples: below 1", [](auto& m) { m.samples = 0; }},
               {"leaves: below 1", [](auto& m) { m.leaves = 0; }},
               {"budget_ms: beyond ten years", [](auto& m) { m.budget_ms = kHuge; }},
               {"num_executed: too many", [](auto& m) { m.num_executed = 65; }},
               {"sharing: neither 0 nor 1", [](auto& m) { m.sharing = 2; }}});
}

TEST(Validate, Task) {
  ExpectFaults<task_t>(
      Task(), {{"name: empty", [](auto& m) { m.name = ""; }},
               {"num_actions: out of range", [](auto& m) { m = task_t{}, m.name = "x"; }},
               {"actions: index out of order", [](auto& m) { m.actions[1].index = 0; }},
               {"actions: successor out of table", [](auto& m) { m.actions[0].successors[0] = 2; }},
               {"initial: out of table", [](auto& m) { m.initial[0] = -1; }},
               {"plan_length: out of range", [](auto& m) { m.plan_length = 0; }},
               {"image: out of range", [](auto& m) { m.image_width = 0; }},
               {"tick_seconds: not positive", [](auto& m) { m.tick_seconds = kNan; }},
               {"action_time_limit: not positive", [](auto& m) { m.action_time_limit = 0; }},
               {"causes: empty name or words", [](auto& m) { m.causes[0].words.clear(); }},
               {"causes: empty name or words", [](auto& m) { m.causes[0].name.clear(); }}});
}

TEST(Validate, SearchStatistics) {
  ExpectFaults<search_statistics_t>(Statistics(),
                                    {{"sequence: negative", [](auto& m) { m.sequence = -1; }},
                                     {"totals: negative", [](auto& m) { m.rollouts = -1; }},
                                     {"totals: negative", [](auto& m) { m.claimed = -1; }}});
}

TEST(Validate, ExpandReply) {
  ExpectFaults<expand_reply_t>(
      Reply(), {{"status: unknown", [](auto& m) { m.status = 4; }},
                {"retry_ms: negative", [](auto& m) { m.retry_ms = -1; }},
                {"evaluations: no probability", [](auto& m) { m.evaluations[0].value = -0.1f; }},
                {"evaluations: no probability",
                 [](auto& m) { m.evaluations[0].done = static_cast<float>(kNan); }},
                {"evaluations: actions out of order", [](auto& m) {
                   m.evaluations[0].actions = {3, 3};
                 }}});
}

TEST(Validate, ExpandRequest) {
  expand_request_t sound{};
  sound.paths = {{1, {4}}};
  SetCounts(sound);
  ExpectFaults<expand_request_t>(
      sound, {{"attempt: negative", [](auto& m) { m.attempt = -1; }},
              {"num_paths: out of range", [](auto& m) { m.num_paths = 0; }},
              {"num_paths: out of range", [](auto& m) { m.num_paths = 257; }},
              {"budget_ms: beyond ten years", [](auto& m) { m.budget_ms = kHuge; }},
              {"paths: bad path", [](auto& m) { m.paths[0].num_actions = 65; }}});
}

TEST(Validate, Label) {
  ExpectFaults<label_t>(Label(),
                        {{"action: out of table", [](auto& m) { m.action = 3; }},
                         {"previous_action: out of table", [](auto& m) { m.previous_action = -1; }},
                         {"segment: below -1", [](auto& m) { m.segment = -2; }},
                         {"seed: below -1", [](auto& m) { m.seed = -2; }},
                         {"segment_end: neither 0 nor 1", [](auto& m) { m.segment_end = 2; }},
                         {"outcome: unknown", [](auto& m) { m.outcome = 4; }},
                         {"light: out of range", [](auto& m) { m.light = kNan; }},
                         {"image_noise: out of range", [](auto& m) { m.image_noise = 2; }}});
}

TEST(Validate, Commands) {
  action_command_t start{};
  start.kind = action_command_t::KIND_START;
  ExpectFaults<action_command_t>(start,
                                 {{"kind: unknown", [](auto& m) { m.kind = 0; }},
                                  {"action: none to start", [](auto& m) { m.action = -1; }},
                                  {"action: out of range", [](auto& m) { m.action = 255; }}});
  sim_command_t reset{};
  reset.kind = sim_command_t::KIND_RESET;
  reset.episode_id = 1;
  ExpectFaults<sim_command_t>(
      reset, {{"kind: unknown", [](auto& m) { m.kind = 4; }},
              {"seed: negative", [](auto& m) { m.seed = -1; }},
              {"present_episode_id: negative", [](auto& m) { m.present_episode_id = -1; }},
              {"episode_id: below 1", [](auto& m) { m.episode_id = 0; }},
              {"objects: out of range", [](auto& m) { m.objects = -1; }},
              {"legs: out of range", [](auto& m) { m.legs = 65; }}});
}

TEST(Validate, StatusPlanAndHealth) {
  ExpectFaults<action_status_t>(action_status_t{},
                                {{"state: unknown", [](auto& m) { m.state = 8; }},
                                 {"outcome: unknown", [](auto& m) { m.outcome = -1; }},
                                 {"action: out of range", [](auto& m) { m.action = -2; }}});
  plan_t plan{};
  plan.steps.resize(1);
  SetCounts(plan);
  ExpectFaults<plan_t>(plan,
                       {{"decision: unknown", [](auto& m) { m.decision = 3; }},
                        {"score: not finite", [](auto& m) { m.score = kNan; }},
                        {"num_executed: more than steps", [](auto& m) { m.num_executed = 2; }},
                        {"steps: negative visits", [](auto& m) { m.steps[0].visits = -1; }}});
  health_t health{};
  health.service = "model";
  ExpectFaults<health_t>(health,
                         {{"service: empty", [](auto& m) { m.service = ""; }},
                          {"state: unknown", [](auto& m) { m.state = 6; }},
                          {"cpu_seconds: not finite", [](auto& m) { m.cpu_seconds = kNan; }}});
}

TEST(Validate, ModelAndPictures) {
  model_info_t info{};
  info.num_actions = 7;
  info.image_width = info.image_height = 64;
  ExpectFaults<model_info_t>(
      info, {{"num_actions: out of range", [](auto& m) { m.num_actions = 0; }},
             {"judges: neither 0 nor 1", [](auto& m) { m.judges = 2; }},
             {"refusal_threshold: out of 0..1", [](auto& m) { m.refusal_threshold = kNan; }},
             {"queue: negative", [](auto& m) { m.queue = -1; }}});
  calibration_t calibration{};
  calibration.parameter_names = {"samples"};
  calibration.parameter_values = {30};
  calibration.scores = {0.25F, 0.5F};
  calibration.classes = {calibration_t::CLASS_SOLVABLE, calibration_t::CLASS_DOUBTFUL};
  calibration.endings = {calibration_t::ENDING_SOLVED, calibration_t::ENDING_REFUSED};
  SetCounts(calibration);
  ExpectFaults<calibration_t>(
      calibration,
      {{"parameter_values: not finite", [](auto& m) { m.parameter_values[0] = INFINITY; }},
       {"scores: not ascending within 0..1", [](auto& m) { m.scores[0] = 0.75F; }},
       {"scores: not ascending within 0..1", [](auto& m) { m.scores[1] = 1.5F; }},
       {"scores: not ascending within 0..1", [](auto& m) { m.scores[0] = -0.5F; }},
       {"scores: not ascending within 0..1",
        [](auto& m) { m.scores[1] = std::numeric_limits<float>::quiet_NaN(); }},
       {"classes: unknown", [](auto& m) { m.classes[0] = 4; }},
       {"endings: unknown", [](auto& m) { m.endings[1] = 0; }}});
  // No picture wanted is sound; half a picture is not.
  ExpectFaults<predict_reply_t>(predict_reply_t{},
                                {{"data: wrong picture size", [](auto& m) { m.width = 64; }},
                                 {"hidden: not finite", [](auto& m) { m.hidden = {INFINITY}; }}});
  predict_reply_t judged{};
  judged.novelty.resize(1);
  judged.novelty[0].p = 0.5;
  SetCounts(judged);
  const std::string novelty = "novelty: out of range";
  ExpectFaults<predict_reply_t>(
      judged, {{"novelty: more than one", [](auto& m) { m.novelty.resize(2), SetCounts(m); }},
               {novelty, [](auto& m) { m.novelty[0].p = 1.5; }},
               {novelty, [](auto& m) { m.novelty[0].p = kNan; }},
               {novelty, [](auto& m) { m.novelty[0].residual = -1; }},
               {novelty, [](auto& m) { m.novelty[0].state_limit = INFINITY; }}});
  ExpectFaults<predict_request_t>(predict_request_t{},
                                  {{"want: neither 0 nor 1", [](auto& m) { m.want_image = 5; }}});
  ExpectFaults<search_stop_t>(search_stop_t{},
                              {{"epoch: negative", [](auto& m) { m.epoch = -1; }}});
  ExpectFaults<verdict_t>(verdict_t{},
                          {{"episode_id: negative", [](auto& m) { m.episode_id = -1; }},
                           {"action: out of range", [](auto& m) { m.action = -1; }},
                           {"succeeded: neither 0 nor 1", [](auto& m) { m.succeeded = 2; }}});
  search_image_t image{};
  image.encoding = observation_t::ENCODING_RGB8;
  image.width = image.height = 1;
  image.data.resize(3);
  SetCounts(image);
  ExpectFaults<search_image_t>(image,
                               {{"data: wrong picture size", [](auto& m) { m.num_bytes = 2; }}});
}

}  // namespace
}  // namespace prospect::messages
