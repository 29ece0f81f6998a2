#include "cli/run/setting.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/options/task.h"
#include "cli/options/weights.h"
#include "cli/run/processes.h"

namespace prospect::cli {
namespace {

namespace fs = std::filesystem;

bool IsReadableFile(const std::string& path) {
  std::error_code none;
  return fs::is_regular_file(path, none) && access(path.c_str(), R_OK) == 0;
}

std::string SceneFile(const SceneOptions& scene) {
  if (!IsReadableFile(scene.scene_file))
    throw ExitError(kExitDataFile, "no scene file at '" + scene.scene_file + "'");
  return fs::canonical(scene.scene_file).string();
}

Words CheckCommand(const SceneOptions& scene, const std::string& task) {
  Words words{PathOf("prospect-simulator"), "--task", TaskOf(task).spec.name, "--check"};
  const Words more = SceneArguments(scene, {}, task);
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

std::string WeightsThere(const std::string& wish, const std::string& task) {
  if (wish == "scripted") return wish;
  const std::string file = WeightsFile(wish, task);
  if (access(file.c_str(), R_OK) == 0) return file;
  throw ExitError(kExitWeights, "no weights at " + file + ": " + Typed("train") + " makes them");
}

Words SceneArguments(const SceneOptions& scene, const StartOptions& start,
                     const std::string& task) {
  Words words;
  const auto add = [&words](const std::string& name, int value) {
    if (value > 0) words.insert(words.end(), {name, std::to_string(value)});
  };
  std::map<std::string, int> sizes = GivenSizes(scene);
  if (const auto& simulator = TaskOf(task).simulator)
    sizes.insert(simulator->scene.begin(), simulator->scene.end());
  for (const auto& [name, value] : sizes) add("--" + name, value);
  if (!scene.scene_file.empty()) words.insert(words.end(), {"--scene-file", SceneFile(scene)});
  if (!start.shift.factor.empty()) words.insert(words.end(), {"--factor", start.shift.factor});
  add("--strength", start.shift.strength);
  return words;
}

Words WorldArguments(const SceneOptions& scene, const std::string& task) {
  if (scene.scene_file.empty()) return {};
  base::ChildOptions options;
  options.command = CheckCommand(scene, task);
  const base::ChildResult said = base::RunCaptured(options, std::chrono::seconds(60));
  std::fputs(said.err.c_str(), stderr);
  if (said.status != 0) throw Ended{said.status.value_or(kExitTimeout)};
  return {"--world", LastLine(said.out)};
}

void TakeKey(const std::string& key) {
  if (key.empty()) return;
  if (access(key.c_str(), R_OK) != 0)
    throw ExitError(kExitDataFile,
                    "no key at '" + key + "': --key wants the file that " + Typed("up") + " names");
  setenv("PROSPECT_KEY_FILE", fs::canonical(key).c_str(), 1);
}

}  // namespace prospect::cli
