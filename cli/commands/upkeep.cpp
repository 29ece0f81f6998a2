#include "cli/commands/upkeep.h"

#include <limits>

#include "cli/installation.h"
#include "cli/options/task.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr char kWorkers[] = "workers=";

CLI::Validator WorkersWish() {
  const CLI::Validator number = Whole(0, 1024);
  return CLI::Validator(
      [number](std::string& text) -> std::string {
        const std::string usage = "N is from 0 to 1024, and this is '" + text + "'";
        if (!text.starts_with(kWorkers)) return usage;
        std::string count = text.substr(sizeof kWorkers - 1);
        if (!number(count).empty()) return usage;
        text = kWorkers + count;
        return "";
      },
      "");
}

void DefineMilliseconds(CLI::App& app, const std::string& name, int& value,
                        const std::string& words) {
  app.add_option(name, value, words)
      ->type_name("MS")
      ->transform(Whole(0, 3'600'000))
      ->capture_default_str();
}

}  // namespace

void Define(CLI::App& app, DownOptions& options) {
  DefineBusUrl(app, options.bus);
  DefineReport(app, options.report);
}

void Define(CLI::App& app, KeyOptions& options) {
  DefineBusUrl(app, options.bus);
  DefineReport(app, options.report);
}

int ScaleOptions::workers() const { return std::stoi(wish.substr(sizeof kWorkers - 1)); }

void Define(CLI::App& app, ScaleOptions& options) {
  app.add_option("workers=N", options.wish, "how many planner workers there shall be, 0 to 1024")
      ->required()
      ->transform(WorkersWish());
  DefineBusUrl(app, options.bus);
  DefineReport(app, options.report);
}

void Define(CLI::App& app, DoctorOptions& options) {
  app.add_flag("--yes", options.mend, "run the commands that mend what is wrong, without asking");
  DefineBusUrl(app, options.bus);
  DefineReport(app, options.report);
}

void Define(CLI::App& app, StatusOptions& options) {
  app.add_option("--seconds", options.seconds, "how long to listen")
      ->type_name("S")
      ->check(Real(0.1, 60))
      ->capture_default_str();
  app.add_flag("--watch", options.watch, "again and again, until Ctrl-C");
  app.add_option("--services-file", options.services_file,
                 "the services.json of a supervisor (default: of the deployment that is up)")
      ->type_name("FILE");
  DefineReport(app, options.report);
  DefineProcess(app, options.bus);
}

void Define(CLI::App& app, CheckRobotOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  app.get_option("--task")->description(
      "compare TASK with this task's file, and carry a plan's actions out, to see whether some "
      "succeed and some fail");
  DefineReport(app, options.report);
  DefineProcess(app, options.bus);
}

void Define(CLI::App& app, SpyOptions& options) {
  app.add_option("--check", options.check,
                 "list channels, types, rates and what could not be decoded for so many seconds, "
                 "without a display")
      ->type_name("SECONDS")
      ->check(Real(0.1, 86400));
  app.add_option("--jar", options.jar, "message types for lcm-spy (default: those of this build)")
      ->type_name("FILE");
  DefineReport(app, options.report);
  DefineBus(app, options.bus);
}

std::string Defect(const SpyOptions& options) {
  if (options.check == 0 && !options.report.json.empty()) return "--json goes with --check SECONDS";
  if (options.check > 0 && !options.jar.empty()) return "--jar is for lcm-spy, not for --check";
  return "";
}

void Define(CLI::App& app, RecordOptions& options) {
  app.add_option("FILE", options.file, "where to; kept as it is if it is there already")
      ->required();
  CLI::Option* overwrite =
      app.add_flag("-f,--force", options.overwrite, "overwrite a file that is there");
  app.add_flag("-a,--append", options.append, "append to it")->excludes(overwrite);
  app.add_option("-c,--channel", options.channels,
                 "a regular expression: only channels that it matches")
      ->type_name("REGEX");
  DefineQuiet(app, options.quiet);
  DefineBusUrl(app, options.bus);
  app.footer("It ends with Ctrl-C. " + Typed("replay FILE") + " plays it again.");
}

void Define(CLI::App& app, PredictOptions& options) {
  app.add_option("--out", options.out, "folder for futures.png, seen.png and a picture a future")
      ->type_name("DIR")
      ->required();
  app.add_option("--actions", options.actions,
                 "what is done from now on, by names in TASK, such as G3,G6 (default: the action "
                 "under way, and after it each that may follow)")
      ->type_name("NAMES");
  app.add_option("--truth", options.truth,
                 "wait so many seconds for what really comes, and show it beside; 0: do not")
      ->type_name("SECONDS")
      ->check(Real(0, 3600))
      ->capture_default_str();
  app.add_option("--seed", options.seed,
                 "wait for the simulated scene of this seed; -1: whichever is there")
      ->type_name("N")
      ->transform(Whole(-1, kLargestSeed))
      ->default_str("-1");
  app.add_flag("--from-start", options.from_start, "wait until the next action begins");
  app.add_option("--segment", options.segment,
                 "wait until this action of the episode begins, 0 the first")
      ->type_name("N")
      ->transform(Whole(0, 100'000))
      ->capture_default_str();
  DefineMilliseconds(app, "--services-timeout-ms", options.services_timeout_ms,
                     "how long to wait for services");
  DefineMilliseconds(app, "--picture-timeout-ms", options.picture_timeout_ms,
                     "how long to wait for a picture, and for an action to begin");
  DefineQuiet(app, options.quiet);
  DefineProcess(app, options.bus);
}

void Define(CLI::App&, NoOptions&) {}

void Define(CLI::App& app, TestOptions& options) {
  app.add_flag("--quick", options.quick, "only tests that are built without libtorch");
  CLI::Option* asan =
      app.add_flag("--asan", options.asan, "build with address and undefined behaviour sanitizers");
  app.add_flag("--tsan", options.tsan, "build with the thread sanitizer")->excludes(asan);
  app.add_flag("--tidy", options.tidy, "only clang-tidy, over every file: slow");
}

void Define(CLI::App& app, CompletionOptions& options) {
  app.add_option("SHELL", options.shell, "bash: source <(" + Typed("completion bash") + ")")
      ->required()
      ->check(OneOf({"bash"}));
}

}  // namespace prospect::cli
