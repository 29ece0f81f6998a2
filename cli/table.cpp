#include "cli/table.h"

#include "cli/commands/bench.h"
#include "cli/commands/ceiling.h"
#include "cli/commands/collect.h"
#include "cli/commands/console.h"
#include "cli/commands/dataset.h"
#include "cli/commands/deployment.h"
#include "cli/commands/evaluate.h"
#include "cli/commands/figures.h"
#include "cli/commands/merge.h"
#include "cli/commands/oracle.h"
#include "cli/commands/replay.h"
#include "cli/commands/tables.h"
#include "cli/commands/takes.h"
#include "cli/commands/tasks.h"
#include "cli/commands/train.h"
#include "cli/commands/upkeep.h"
#include "cli/commands/verify.h"
#include "cli/commands/view.h"

namespace prospect::cli {
namespace {

// One line of the table. `program`, `arguments` and `also` as in Command.
template <typename Options>
Command Row(std::string name, std::string summary, std::string program = "",
            std::vector<std::string> arguments = {}, std::vector<std::string> also = {}) {
  return {std::move(name),      Group::kTry,     std::move(summary), std::move(program),
          std::move(arguments), std::move(also), Defined<Options>()};
}

std::vector<Command> TryCommands() {
  return {
      Row<DemoOptions>("demo", "one episode with everything started for it; shows the plan"),
      Row<ExplainOptions>("explain",
                          "look at the scene, search once and tell why; nothing is carried out"),
      Row<NoOptions>("setup", "install and build everything; else a program is built when needed"),
      Row<TestOptions>("test", "install, build, run the tests"),
  };
}

std::vector<Command> RunCommands() {
  return {
      Row<UpOptions>("up", "start simulator, model server and planner workers"),
      Row<RunOptions>("run", "one episode against the services that are up"),
      Row<ScaleOptions>("scale", "more or fewer planner workers while they run"),
      Row<DownOptions>("down", "stop what is up"),
      Row<KeyOptions>("key", "the file of the deployment's key, which a robot needs"),
      Row<TasksOptions>("tasks", "the tasks that are known, and what each has"),
      Row<TaskCheckOptions>("task check", "what is wrong or missing in a task file",
                            "prospect-data", {"task-check"}),
      Row<TaskLearnOptions>("task learn", "a first task file, from what a robot says on the bus",
                            "prospect-bus", {"task-learn"}),
      Row<CheckRobotOptions>("check-robot", "try a robot in the simulator's place: it moves",
                             "prospect-bus", {"check-robot"}),
      Row<DoctorOptions>("doctor",
                         "what this machine lacks for a deployment, and how it is mended"),
  };
}

std::vector<Command> LookCommands() {
  return {
      Row<ConsoleOptions>(
          "console", "a page in the browser: what it sees, imagines and does, live or from a log",
          "prospect-console"),
      Row<StatusOptions>("status",
                         "each process: state, age of its last sign of life, queue, restarts",
                         "prospect-bus", {"status"}),
      Row<SpyOptions>("spy", "look at the bus with lcm-spy, or count what is said on it"),
      Row<RecordOptions>("record", "write the bus to a file"),
      Row<ReplayOptions>("replay", "play a recording onto a bus of its own, without commands",
                         "prospect-bus", {"play"}),
      Row<RebuildBusOptions>(
          "rebuild bus", "search again what a recording holds: evaluations and rows of each search",
          "prospect-bus", {"rebuild-bus"}),
      Row<RebuildJournalOptions>("rebuild journal", "repeat a worker's choices from its journal",
                                 "prospect-bus", {"rebuild-journal"}),
      Row<PredictOptions>("predict", "pictures of what comes next in the scene that is up",
                          "prospect-video", {"predict"}),
      Row<ViewOptions>("view", "a picture of a scene, at any size and from any camera",
                       "prospect-world", {"view"}),
      Row<NoOptions>("messages", "the message reference, from lcmtypes/"),
      Row<NoOptions>("version", "the version"),
      Row<CompletionOptions>("completion", "completions for a shell"),
  };
}

std::vector<Command> TrainCommands() {
  return {
      Row<CollectOptions>("collect", "make training trials", "prospect-data", {"collect"}),
      Row<DatasetInfoOptions>("dataset info", "what a data set holds", "prospect-data", {"info"}),
      Row<DatasetPackOptions>("dataset pack", "join trial files into one data set", "prospect-data",
                              {"pack"}),
      Row<DatasetSheetOptions>("dataset sheet", "a picture of trials, a row each", "prospect-data",
                               {"sheet"}),
      Row<DatasetFromLogOptions>("dataset from-log", "a data set of recordings of the bus",
                                 "prospect-data", {"from-log"}),
      Row<DatasetFromVideoOptions>(
          "dataset from-video", "a data set of videos and of tables that say what is done in them",
          "prospect-data", {"from-video"}),
      Row<DatasetFromRobomimicOptions>("dataset from-robomimic",
                                       "a data set of demonstrations in robomimic's layout",
                                       "prospect-data", {"from-robomimic"}),
      Row<DatasetExportOptions>("dataset export", "a data set as robomimic reads one",
                                "prospect-data", {"export"}),
      Row<MergeOptions>("merge", "join what processes with --shard made into one file"),
      Row<TrainOptions>("train", "train the networks", "prospect-train", {"train"}),
  };
}

std::vector<Command> MeasureCommands() {
  return {
      Row<VerifyOptions>("verify", "measure the figures of docs/results.md again",
                         "prospect-verify", {},
                         {"prospect-data", "prospect-evaluate", "prospect-train"}),
      Row<EvaluateOptions>("evaluate", "closed loop on scenes that were never trained on",
                           "prospect-evaluate", {"run"}),
      Row<EvaluatePlansOptions>("evaluate plans",
                                "which plans work: each scored, and carried out many times",
                                "prospect-evaluate", {"plans"}),
      Row<EvaluateShiftsOptions>("evaluate shifts",
                                 "open loop with pictures unlike those of trials",
                                 "prospect-evaluate", {"shifts"}),
      Row<EvaluateDataOptions>("evaluate data",
                               "what the networks say of recorded trials, and what came of them",
                               "prospect-evaluate", {"data"}),
      Row<EvaluateOnBusOptions>("evaluate on-bus",
                                "closed loop with whatever is on the bus: a simulator, a robot",
                                "prospect-evaluate", {"on-bus"}),
      Row<CalibrateOptions>("evaluate calibrate",
                            "find the refusal threshold and store it in the weights",
                            "prospect-evaluate", {"calibrate"}),
      Row<NoveltyOptions>("evaluate novelty",
                          "store in the weights what known pictures look like to them",
                          "prospect-evaluate", {"novelty"}),
      Row<RefusalsOptions>("evaluate refusals", "whether the promises about refusals hold",
                           "prospect-evaluate", {"refusals"}),
      Row<TablesOptions>("tables", "pictures and labels after one and two actions, of variants",
                         "prospect-train", {"tables"}),
      Row<FiguresOptions>("figures", "pictures of what the networks keep, imagine and judge",
                          "prospect-figures"),
      Row<OracleOptions>("oracle", "what a world's scenes allow, by trying every plan",
                         "prospect-world", {"oracle"}),
      Row<CeilingOptions>("ceiling", "how well what V, f and T are asked can be known at all",
                          "prospect-world", {"ceiling"}),
      Row<TakesOptions>("takes", "how far two takes of one action differ", "prospect-world",
                        {"takes"}),
      Row<BenchSearchOptions>("bench search",
                              "speed and decisions of searches over a bus with 1 to 16 workers"),
      Row<BenchSimulatedOptions>("bench simulated", "the same on a virtual clock, without a bus",
                                 "prospect-bench", {"simulated"}),
      Row<BenchOverheadOptions>("bench overhead", "what a rollout costs", "prospect-bench",
                                {"overhead"}),
      Row<BenchSimOptions>("bench sim", "speed of the worlds on one core", "prospect-bench",
                           {"sim"}),
      Row<BenchPicksOptions>("bench picks",
                             "picks and places in free space, with noise and without",
                             "prospect-bench", {"picks"}),
      Row<BenchTrainOptions>("bench train", "speed of each stage of training", "prospect-train",
                             {"bench"}),
      Row<BenchEngineOptions>("bench engine", "speed of the engine on one core, beside libtorch's",
                              "prospect-train", {"bench-engine"}),
  };
}

void Append(Group group, std::vector<Command> rows, std::vector<Command>* table) {
  for (Command& row : rows) {
    row.group = group;
    table->push_back(std::move(row));
  }
}

std::vector<Command> Table() {
  std::vector<Command> table;
  Append(Group::kTry, TryCommands(), &table);
  Append(Group::kRun, RunCommands(), &table);
  Append(Group::kLook, LookCommands(), &table);
  Append(Group::kTrain, TrainCommands(), &table);
  Append(Group::kMeasure, MeasureCommands(), &table);
  return table;
}

}  // namespace

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = Table();
  return commands;
}

const Command* FindCommand(std::string_view name) {
  for (const Command& command : Commands())
    if (command.name == name) return &command;
  return nullptr;
}

}  // namespace prospect::cli
