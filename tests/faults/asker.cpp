// fault-asker: asks for searches of the scripted tree, one after the other, without a simulator,
// and prints one line of JSON for each answer. For tests that disturb searches from outside.

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/run_main.h"
#include "planner/scripted_tree.h"
#include "services/binding/search_messages.h"
#include "services/binding/task_messages.h"
#include "services/common/common_options.h"
#include "services/executive/search_session.h"
#include "services/model/scripted_tree_engine.h"

namespace {

using namespace prospect;
using namespace prospect::services;

struct Options {
  CommonOptions common;
  int workers = 1, servers = 1;
  int searches = 1;
  std::int64_t samples = 800;
  std::int64_t budget_ms = -1;
  std::int64_t seed = 0;
};

task_t ScriptedTask() {
  task_t task{};
  task.name = ScriptedTreeEngine::kTask;
  task.world_version = "test";
  task.num_actions = task.num_initial = planner::ScriptedTree::kBranching;
  for (int a = 0; a < task.num_actions; ++a) task.initial.push_back(a);
  for (int a = 0; a < task.num_actions; ++a) {
    action_t action{};
    action.index = a;
    action.name = "action(" + std::to_string(a) + ")";
    action.kind = "action";
    action.successors = task.initial;
    action.num_successors = task.num_actions;
    task.actions.push_back(action);
  }
  task.plan_length = planner::ScriptedTree::kDepth;
  task.repeats_allowed = 1;
  task.image_width = task.image_height = ScriptedTreeEngine::kImageSize;
  task.tick_seconds = 0.1;
  task.action_time_limit = 10;
  task.task_hash = TaskHash(task);
  return task;
}

SearchQuestion QuestionFor(const Options& options, const task_t& task, std::int64_t seed) {
  SearchQuestion question;
  search_image_t image{};
  image.image_id = seed + 1;
  image.encoding = observation_t::ENCODING_RGB8;
  image.width = image.height = ScriptedTreeEngine::kImageSize;
  image.data = ScriptedTreeEngine::PictureOf(static_cast<std::uint64_t>(seed));
  image.num_bytes = static_cast<std::int32_t>(image.data.size());
  question.first = question.present = image;
  question.budget_ms = options.budget_ms;
  question.samples = options.samples;
  auto& root = question.root;
  root.task_hash = task.task_hash;
  root.task = task.name;
  root.image0_id = root.image_id = image.image_id;
  root.plan_length = task.plan_length;
  root.time_left = -1;
  root.leaves = 2;
  root.sharing = 1;
  planner::SearchParameters parameters;
  parameters.samples = options.samples;
  parameters.depth = task.plan_length;
  parameters.seed = static_cast<std::uint64_t>(seed);
  SetParameters(parameters, &root);
  return question;
}

// Says the task every half second for as long as it lives, as a simulator would: servers and
// workers come and go.
class TaskTeller {
 public:
  TaskTeller(Bus& bus, task_t task) : thread_([this, &bus, task] { Tell(bus, task); }) {}
  ~TaskTeller() {
    over_ = true;
    thread_.join();
  }

 private:
  void Tell(Bus& bus, task_t task) {
    for (int tick = 0; !over_; ++tick) {
      task.utime = UtimeNow();
      if (tick % 10 == 0) bus.PublishRaw(ChannelOf<task_t>(), messages::CheckedEncode(task));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  std::atomic<bool> over_{false};
  std::thread thread_;
};

void Print(const SearchAnswer& answer) {
  const nlohmann::json line = {{"ended_by", answer.ended_by},       {"rollouts", answer.rollouts},
                               {"evaluations", answer.evaluations}, {"workers", answer.workers},
                               {"converged", answer.converged},     {"seconds", answer.seconds}};
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

void AddOptions(CLI::App& app, Options& options) {
  cli::DefineProcess(app, options.common);
  app.add_option("--workers", options.workers, "workers to wait for");
  app.add_option("--servers", options.servers, "model servers to wait for");
  app.add_option("--searches", options.searches, "how many, one after the other");
  app.add_option("--samples", options.samples, "rollouts a search");
  app.add_option("--budget-ms", options.budget_ms, "time for a search; -1: none");
  app.add_option("--seed", options.seed, "tree of the first search");
}

int Run(int argc, char** argv) {
  CLI::App app("asks for searches of the scripted tree");
  Options options;
  AddOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  ApplyCommonOptions(options.common, "asker");

  Bus bus(options.common.bus);
  Conversation talk(bus);
  const task_t task = ScriptedTask();
  const TaskTeller teller(bus, task);
  SearchSession session(talk);
  const auto ready = [&] {
    return talk.view().task() &&
           talk.monitor().Alive("worker").size() >= static_cast<std::size_t>(options.workers) &&
           talk.view().servers().Live(0, SteadyMs()).size() >=
               static_cast<std::size_t>(options.servers);
  };
  if (!talk.Until(ready, 20000)) throw ExitError(kExitServiceLost, "services did not come up");
  for (int i = 0; i < options.searches; ++i)
    Print(session.Search(QuestionFor(options, task, options.seed + i)));
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}
