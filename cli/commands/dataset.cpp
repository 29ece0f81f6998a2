#include "cli/commands/dataset.h"

#include "cli/options/common.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr const char* kJigsawsHelp =
    R"(Read are ROOT/TASK/transcriptions/NAME.txt (lines 'FIRST LAST Gk', frames from 1) and
ROOT/TASK/video/NAME_capture1.avi, the left camera; kinematics/ and meta_file are not.
NAME is TASK_XNNN: X the user, NNN the number; the trial's seed is 1000 * (X - 'A') + NNN.
Pictures become 128x96. Gesture Gk is action k - 1, 15 is none.

Frames before the first gesture and after the last are not used. A frame between two gestures
belongs to the one before it. A gesture's goal picture is the frame on which the next one begins;
the last gesture's is its own last frame.

A trial is left out, with a line that says why, when its video or transcription is missing or
cannot be read, or when the transcription holds another gesture than G1 to G15, gestures out of
order, or none. It is repaired, with a line a repair, when a gesture runs into the next one (it
ends where that begins) and when the transcription goes beyond the video (it is cut there).
The data set appears under its name when it is whole, and not at all if no trial can be used.)";

void DefineFile(CLI::App& app, std::string& file) {
  app.add_option("FILE", file, "the data set")->required();
}

std::string UserDefect(const std::string& user) {
  const bool letter = user.size() == 1 && user[0] >= 'A' && user[0] <= 'Z';
  return letter ? "" : "wants a letter, A to Z, not '" + user + "'";
}

}  // namespace

void Define(CLI::App& app, DatasetInfoOptions& options) {
  DefineFile(app, options.file);
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

void Define(CLI::App& app, DatasetJigsawsOptions& options) {
  app.footer(kJigsawsHelp);
  app.add_option("--root", options.root, "folder that holds the task's folder")
      ->type_name("DIR")
      ->required();
  app.add_option("--task", options.folder, "the task's folder")
      ->type_name("NAME")
      ->required()
      ->check(OneOf({"Suturing", "Knot_Tying", "Needle_Passing"}));
  DefineOut(app, options.out, "the data set to write", "FILE")->required();
  app.add_option("--every", options.every,
                 "keep one frame in so many, besides the first of each gesture and the last")
      ->type_name("N")
      ->transform(Whole(1, 1000))
      ->capture_default_str();
  CLI::Option* trials = app.add_option("--hold-out", options.hold_out,
                                       "so many trials are held out for the figures, by a hash of "
                                       "their names")
                            ->type_name("N")
                            ->transform(Whole(0, 1000))
                            ->capture_default_str();
  CLI::Option* names = app.add_option("--hold-out-trials", options.hold_out_trials,
                                      "these are held out instead, such as B001,C003")
                           ->type_name("NAMES")
                           ->delimiter(',')
                           ->excludes(trials);
  app.add_option("--hold-out-user", options.hold_out_user,
                 "this user's are held out instead, such as B")
      ->type_name("LETTER")
      ->check(CLI::Validator(UserDefect, "A to Z"))
      ->excludes(trials)
      ->excludes(names);
  app.add_option("--valid", options.valid,
                 "so many of the others only choose between settings, by the same hash")
      ->type_name("N")
      ->transform(Whole(0, 1000))
      ->capture_default_str();
  DefineQuiet(app, options.quiet);
}

}  // namespace prospect::cli
