#include "cli/run/starting.h"

#include <filesystem>

#include "cli/options/task.h"
#include "cli/run/setting.h"
#include "tasks/task_folder.h"

namespace prospect::cli {

int WorkersOf(int wish, const std::string& task) {
  return wish > 0 ? wish : TaskOf(task).only_predicted ? 0 : kUsualWorkers;
}

Starting StartingOf(const EpisodeOptions& episode, const StartOptions& start,
                    const std::string& task, bool searches) {
  TakeKey(episode.bus.key);
  Starting starting;
  starting.task = TaskOf(task).spec.name;
  if (tasks::MeansFile(task)) starting.task_file = std::filesystem::canonical(task).string();
  starting.workers = WorkersOf(episode.workers, task);
  starting.scene = SceneArguments(episode.scene, start, task);
  const bool scripted = start.weights.empty() && !searches;
  starting.weights = WeightsThere(scripted ? "scripted" : start.weights, task);
  starting.chaos = episode.bus.chaos;
  starting.open = start.open;
  return starting;
}

Words ArgumentsOf(const Starting& starting, const std::string& logs) {
  Words words{"--task",    starting.task,   "--workers", std::to_string(starting.workers),
              "--weights", starting.weights};
  if (!starting.task_file.empty()) words.insert(words.end(), {"--task-file", starting.task_file});
  if (!starting.chaos.empty()) words.insert(words.end(), {"--chaos", starting.chaos});
  if (!logs.empty()) words.insert(words.end(), {"--logs", logs});
  if (starting.open) words.push_back("--open");
  words.push_back("--");
  words.insert(words.end(), starting.scene.begin(), starting.scene.end());
  return words;
}

Words DeployedPrograms() {
  return {"prospect-supervisor", "prospect-simulator", "prospect-model-server",
          "prospect-worker",     "prospect-executive", "prospect-bus"};
}

}  // namespace prospect::cli
