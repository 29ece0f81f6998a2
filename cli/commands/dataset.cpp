#include "cli/commands/dataset.h"

#include "cli/options/common.h"
#include "cli/options/task.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr const char* kVideoHelp =
    R"(DIR holds NAME.mp4 (avi, mkv, mov, webm) and NAME.csv for each trial: a row
    start,end,action,succeeded[,cause]
an action, times in seconds of the video, the action by its name in the task file or its number,
succeeded 1 or 0; the first line may name the columns. Or it is a task's folder of JIGSAWS, as it
is distributed: video/NAME_capture1.avi, the left camera, and transcriptions/NAME.txt, lines
'FIRST LAST Gk', frames from 1. Pictures are scaled to the task's size.

Frames before the first action (in a CSV: but one) and after the last are not used. A frame between
two actions belongs to the one before it. An action's goal picture is the frame on which the next
one begins; the last action's is its own last frame. A trial has succeeded if its last action has.

A trial is repaired, with a line a repair that names file and line, when rows are out of order
(they are sorted), when an action runs into the next one (it ends where that begins), and when the
table goes beyond the video (it is cut there). It is left out, with a line that says why, when a
file is missing or cannot be read, when a row means nothing (its frames would count as the action
before), and when its actions all succeeded but are fewer than a plan has, where the task is
planned. The data set appears under its name when it is whole, and not at all if no trial can be
used.)";

constexpr const char* kRobomimicHelp =
    R"(Of FILE pictures and masks are read. The segments are a CSV, a row
    demo,start,end,action,succeeded[,cause]
an action, indices of pictures from 0, end included; dataset export writes such a table, too.
Pictures that are kept are a tick of the task apart. What is repaired and left out: as in
dataset from-video.)";

constexpr const char* kExportHelp =
    R"(Written are obs, actions (1 for the action that is done from a picture to the next), rewards,
dones, num_samples, total, env_args and the masks train, valid and test.)";

void DefineFile(CLI::App& app, std::string& file) {
  app.add_option("FILE", file, "the data set")->required();
}

void DefineTaskOfData(CLI::App& app, std::string& task) {
  DefineTask(app, task, Tasks::kAll)
      ->description(
          "whose actions they are; without it the installed task of the data's name, if its table "
          "is the data's")
      ->default_str("");
}

}  // namespace

void Define(CLI::App& app, DatasetInfoOptions& options) {
  DefineFile(app, options.file);
  DefineTaskOfData(app, options.task);
  DefineReport(app, options.report);
}

void Define(CLI::App& app, DatasetPackOptions& options) {
  app.add_option("INPUTS", options.inputs, "trial files, data sets, or folders of them")
      ->required();
  DefineOut(app, options.out, "the data set to write", "FILE")->required();
  app.add_option("--split", options.split, "only trials of this part")
      ->type_name("NAME")
      ->check(OneOf({"train", "valid", "test"}));
  app.add_option("--trials", options.trials, "only the first so many of them, by seed")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000));
  DefineQuiet(app, options.quiet);
}

void Define(CLI::App& app, DatasetSheetOptions& options) {
  DefineFile(app, options.file);
  DefineTaskOfData(app, options.task);
  DefineOut(app, options.out, "the PNG to write", "FILE")->required();
  app.add_option("--rows", options.rows, "trials to show")
      ->type_name("N")
      ->transform(Whole(1, 200))
      ->capture_default_str();
  DefineSeed(app, options.seed, "which trials are drawn");
  DefineQuiet(app, options.quiet);
}

void Define(CLI::App& app, DatasetFromLogOptions& options) {
  app.add_option("LOGS", options.logs, "logs that lcm-logger wrote")->required();
  DefineOut(app, options.out, "the data set to write (HDF5)", "FILE")->required();
  DefineReport(app, options.report);
}

void Define(CLI::App& app, DatasetFromVideoOptions& options) {
  app.footer(kVideoHelp);
  app.add_option("DIR", options.folder, "folder of videos and tables")->required();
  DefineTask(app, options.task, Tasks::kAll)->required();
  DefineOut(app, options.out, "the data set to write", "FILE")->required();
  app.add_option("--every", options.every,
                 "keep one frame in so many, besides the first of each action and the last")
      ->type_name("N")
      ->transform(Whole(1, 1000))
      ->default_str("one a tick of the task");
  app.add_option("--hold-out", options.held_out,
                 "test on these: names, their ends, or beginnings with a star, such as B001,C_*")
      ->type_name("NAMES")
      ->delimiter(',')
      ->default_str("a tenth, by a hash of names");
  DefineQuiet(app, options.quiet);
}

void Define(CLI::App& app, DatasetFromRobomimicOptions& options) {
  app.footer(kRobomimicHelp);
  app.add_option("FILE", options.file, "demonstrations (HDF5)")->required();
  DefineTask(app, options.task, Tasks::kAll)->required();
  app.add_option("--segments", options.segments, "which actions ran when (CSV)")
      ->type_name("FILE")
      ->required();
  DefineOut(app, options.out, "the data set to write", "FILE")->required();
  app.add_option("--camera", options.camera, "whose pictures, where there are several")
      ->type_name("NAME");
  app.add_option("--every", options.every, "keep one picture in so many")
      ->type_name("N")
      ->transform(Whole(1, 1000))
      ->capture_default_str();
  DefineQuiet(app, options.quiet);
}

void Define(CLI::App& app, DatasetExportOptions& options) {
  app.footer(kExportHelp);
  DefineFile(app, options.file);
  DefineOut(app, options.out, "the file to write (HDF5)", "FILE")->required();
  app.add_flag("--next-obs", options.next_obs, "with each picture the one after it, too");
  app.add_option("--segments", options.segments,
                 "write a table, too, which actions ran when, as dataset from-robomimic takes it")
      ->type_name("FILE");
  DefineQuiet(app, options.quiet);
}

}  // namespace prospect::cli
