#include "services/bench/search_bench.h"

#include <algorithm>

#include "planner/scripted_tree.h"
#include "services/binding/search_messages.h"
#include "services/binding/task_messages.h"
#include "services/model/scripted_tree_engine.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kInfoMs = 5000;
constexpr int kTaskRepeats = 3;

bool IsScriptedTree(const model_info_t& model) { return model.task == ScriptedTreeEngine::kTask; }

// Any action may follow any other, so that the tree is as large for every network.
task_t TaskFor(const model_info_t& model, int plan_length) {
  task_t task{};
  task.name = model.task;
  task.world_version = "bench";
  task.num_actions = model.num_actions;
  for (int a = 0; a < model.num_actions; ++a) task.initial.push_back(a);
  task.num_initial = model.num_actions;
  for (int a = 0; a < model.num_actions; ++a) {
    action_t action{};
    action.index = a;
    action.name = "action(" + std::to_string(a) + ")";
    action.kind = "action";
    action.successors = task.initial;
    action.num_successors = model.num_actions;
    task.actions.push_back(action);
  }
  task.plan_length = plan_length;
  task.repeats_allowed = 1;
  task.image_width = model.image_width;
  task.image_height = model.image_height;
  task.tick_seconds = 0.1;
  task.action_time_limit = 10;
  task.task_hash = TaskHash(task);
  return task;
}

// The scripted tree's seed, or noise that is a function of it.
std::vector<std::uint8_t> PictureFor(const model_info_t& model, std::int64_t seed) {
  if (IsScriptedTree(model)) return ScriptedTreeEngine::PictureOf(static_cast<std::uint64_t>(seed));
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(model.image_width) *
                                    static_cast<std::size_t>(model.image_height) * 3);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture[i] = static_cast<std::uint8_t>(
        planner::HashCombine(static_cast<std::uint64_t>(seed), i / 3 / 64) >> 8 * (i % 3));
  }
  return picture;
}

std::int64_t Batches(const std::vector<model_info_t>& infos) {
  std::int64_t sum = 0;
  for (const auto& info : infos) sum += info.batches;
  return sum;
}

std::int64_t Evaluations(const std::vector<model_info_t>& infos) {
  std::int64_t sum = 0;
  for (const auto& info : infos) sum += info.evaluations;
  return sum;
}

double ComputeSeconds(const std::vector<model_info_t>& infos) {
  double sum = 0;
  for (const auto& info : infos) sum += info.compute_seconds;
  return sum;
}

}  // namespace

SearchBench::SearchBench(Conversation& talk, const cli::BenchSearchOptions& options,
                         const std::string& logs)
    : talk_(talk), options_(options), crew_(talk, logs), traffic_(talk.bus()), session_(talk) {
  std::vector<std::string> arguments{"--weights",   options_.weights,
                                     "--max-batch", std::to_string(options_.max_batch),
                                     "--threads",   std::to_string(options_.threads)};
  if (options_.fixed_cost != "none") {
    arguments.insert(arguments.end(), {"--fixed-cost", options_.fixed_cost});
  }
  crew_.StartServers(options_.servers, arguments);
  PrepareTask();
}

void SearchBench::PrepareTask() {
  const auto known = [this] {
    return talk_.view().servers().Live(0, SteadyMs()).size() ==
           static_cast<std::size_t>(options_.servers);
  };
  if (!talk_.Until(known, kInfoMs)) throw ExitError(kExitServiceLost, "no MODEL_INFO");
  model_ = talk_.view().servers().Live(0, SteadyMs()).front();
  if (IsScriptedTree(model_)) options_.plan_length = planner::ScriptedTree::kDepth;
  task_ = TaskFor(model_, options_.plan_length);
}

// Said a few times, because it is not said for ever: there is no simulator here.
void SearchBench::TellTask() {
  int left = kTaskRepeats;
  talk_.Until([&] { return left == 0; }, kInfoMs, [&] { talk_.Say(task_), --left; }, 5);
}

SearchQuestion SearchBench::QuestionFor(std::int64_t seed, int workers, int leaves) const {
  SearchQuestion question;
  search_image_t image{};
  image.image_id = 1;
  image.encoding = observation_t::ENCODING_RGB8;
  image.width = model_.image_width;
  image.height = model_.image_height;
  image.data = PictureFor(model_, seed);
  image.num_bytes = static_cast<std::int32_t>(image.data.size());
  question.first = question.present = image;
  auto& root = question.root;
  root.weights_hash = model_.weights_hash;
  root.task_hash = task_.task_hash;
  root.task = task_.name;
  root.image0_id = root.image_id = image.image_id;
  root.plan_length = task_.plan_length;
  root.time_left = -1;
  root.leaves = leaves;
  planner::SearchParameters parameters;
  parameters.UseRule(options_.rule);
  parameters.sharing = options_.sharing;
  parameters.workers = workers;
  parameters.samples = options_.samples;
  parameters.depth = options_.plan_length;
  parameters.seed = static_cast<std::uint64_t>(seed);
  if (!options_.prune) parameters.c_done = parameters.v_failed = parameters.p_min = 0;
  question.samples = parameters.samples;
  SetParameters(parameters, &root);
  return question;
}

// Servers say how they fared when a search stops, and once a second.
std::vector<model_info_t> SearchBench::FreshInfos(std::int64_t since_utime) {
  std::vector<model_info_t> infos;
  const auto fresh = [&] {
    infos = talk_.view().servers().Live(model_.weights_hash, SteadyMs());
    return std::all_of(infos.begin(), infos.end(),
                       [&](const auto& info) { return info.utime > since_utime; });
  };
  if (!talk_.Until(fresh, kInfoMs)) throw ExitError(kExitServiceLost, "a model server fell silent");
  return infos;
}

void SearchBench::FillFromServers(const std::vector<model_info_t>& before, SearchRun* run) {
  const auto after = FreshInfos(UtimeNow());
  run->batches = Batches(after) - Batches(before);
  run->evaluations = Evaluations(after) - Evaluations(before);
  run->batch_seconds = ComputeSeconds(after) - ComputeSeconds(before);
}

SearchRun SearchBench::MeasureOne(std::int64_t seed, int workers, int leaves) {
  SearchRun run;
  run.seed = seed;
  const auto before = FreshInfos(0);
  const double server_cpu = crew_.ServerCpu(), worker_cpu = crew_.WorkerCpu();
  traffic_.Reset();
  const SearchAnswer answer = session_.Search(QuestionFor(seed, workers, leaves));
  run.server_cpu = crew_.ServerCpu() - server_cpu;
  run.worker_cpu = crew_.WorkerCpu() - worker_cpu;
  run.rollouts = answer.rollouts;
  run.requested = answer.requested;
  run.seconds = answer.searching_seconds;
  run.converged = answer.converged;
  run.statistics_bytes = traffic_.statistics_bytes();
  run.request_bytes = traffic_.request_bytes();
  run.reply_bytes = traffic_.reply_bytes();
  run.requests = traffic_.requests();
  run.resent = traffic_.resent();
  run.busy = traffic_.busy();
  run.latency_p50 = traffic_.Latency(0.5);
  run.latency_p90 = traffic_.Latency(0.9);
  run.latency_p99 = traffic_.Latency(0.99);
  run.score = answer.plan.ok() ? answer.plan.best.score : 0;
  FillFromServers(before, &run);
  if (!IsScriptedTree(model_)) return run;
  const auto best = planner::ScriptedTree{static_cast<std::uint64_t>(seed)}.FindOptimum();
  run.optimum = best.value;
  run.optimal = answer.plan.ok() && answer.plan.best.path == best.path;
  return run;
}

std::vector<SearchRun> SearchBench::Measure(int workers, int leaves) {
  crew_.HaveWorkers(workers);
  TellTask();
  std::vector<SearchRun> runs;
  for (int i = 0; i < options_.seeds; ++i)
    runs.push_back(MeasureOne(options_.first_seed + i, workers, leaves));
  return runs;
}

}  // namespace prospect::services
