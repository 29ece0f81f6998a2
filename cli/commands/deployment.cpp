#include "cli/commands/deployment.h"

#include "base/text.h"
#include "cli/installation.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

bool HasSize(const SceneOptions& scene) {
  return scene.objects > 0 || scene.legs > 0 || scene.tower > 0;
}

std::vector<std::string> Predicted() {
  std::vector<std::string> names = TaskNames(Tasks::kAll);
  std::erase_if(names, [](const std::string& name) { return !TaskOf(name).only_predicted; });
  return names;
}

std::string RobotAdvice(const std::string& task) {
  return TaskOf(task).spec.name +
         " has no built-in simulator: " + Typed("up --no-simulator --task ") + task +
         ", and a robot takes its place";
}

// The first that says something.
std::string First(const std::string& a, const std::string& b) { return a.empty() ? b : a; }

std::string NoResetDefect(bool reset, const SceneOptions& scene) {
  if (reset || !HasSize(scene)) return "";
  return "--no-reset takes the scene as it is: leave out --objects, --legs and --tower";
}

}  // namespace

void Define(CLI::App& app, DemoOptions& options) {
  DefineEpisode(app, options.episode);
  DefineSceneFile(app, options.episode.scene);
  DefineActing(app, options.acting);
  DefineStart(app, options.start);
  DefineBus(app, options.episode.bus);
}

std::string Defect(const DemoOptions& options) {
  const std::string& task = options.episode.task;
  const tasks::TaskFile& file = TaskOf(task);
  if (!file.simulator && file.only_predicted)
    return file.spec.name + " has no simulated scene: for a video of it, " + Typed("up --task ") +
           task + " --video FILE, then " + Typed("predict");
  if (!file.simulator) return RobotAdvice(task);
  return First(EpisodeDefect(options.episode), StartDefect(options.start, task));
}

void Define(CLI::App& app, ExplainOptions& options) {
  DefineEpisode(app, options.episode);
  DefineSceneFile(app, options.episode.scene);
  DefineWhatIf(app, options.what_if);
  DefineNoReset(app, options.reset);
  DefineStart(app, options.start);
  DefineBus(app, options.episode.bus);
}

std::string Defect(const ExplainOptions& options) {
  const EpisodeOptions& episode = options.episode;
  const std::string wrong =
      First(EpisodeDefect(episode), NoResetDefect(options.reset, episode.scene));
  return episode.task.empty() ? wrong : First(wrong, StartDefect(options.start, episode.task));
}

void Define(CLI::App& app, UpOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  DefineScene(app, options.scene);
  app.add_option("--workers", options.workers, "planner workers")
      ->type_name("N")
      ->transform(Whole(1, 1024))
      ->default_str("2; none where gestures are only predicted");
  DefineStart(app, options.start);
  app.add_option("--video", options.video,
                 "play it in the simulator's place, of a task that is only predicted")
      ->type_name("FILE");
  app.add_option("--transcription", options.transcription, "its gestures, as in JIGSAWS")
      ->type_name("FILE")
      ->needs("--video");
  app.add_flag("!--no-simulator", options.simulator, "a robot takes the simulator's place");
  app.add_flag("--console", options.console, "with a page in the browser: " + Typed("console"));
  app.add_flag("--control", options.control, "let that page start and stop episodes")
      ->needs("--console");
  app.add_flag("--foreground", options.foreground, "stay here; Ctrl-C stops everything");
  DefineReport(app, options.report);
  DefineBus(app, options.bus);
}

std::string Defect(const UpOptions& options) {
  const tasks::TaskFile& task = TaskOf(options.task);
  if (!task.only_predicted && !options.video.empty())
    return "--video is for tasks that are only predicted, such as " + base::Joined(Predicted());
  if (task.only_predicted && !task.simulator && options.video.empty())
    return task.spec.name + " has no simulated scene: give --video FILE";
  if (!task.only_predicted && !task.simulator && options.simulator)
    return RobotAdvice(options.task);
  return First(SceneDefect(options.scene, options.task), StartDefect(options.start, options.task));
}

void Define(CLI::App& app, RunOptions& options) {
  DefineEpisode(app, options.episode);
  DefineSceneFile(app, options.episode.scene);
  DefineActing(app, options.acting);
  DefineTrialLoop(app, options.trials);
  DefineNoReset(app, options.reset);
  DefineAsk(app, options.ask);
  DefineWeights(app, options.weights);
  DefineBus(app, options.episode.bus);
}

std::string Defect(const RunOptions& options) {
  return First(
      TrialLoopDefect(options.trials, options.acting),
      First(EpisodeDefect(options.episode), NoResetDefect(options.reset, options.episode.scene)));
}

}  // namespace prospect::cli
