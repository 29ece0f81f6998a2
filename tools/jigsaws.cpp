// prospect-jigsaws: videos and transcriptions in the layout of JIGSAWS to a data set.

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

#include "model/jigsaws/gestures.h"
#include "tools/common/program.h"
#include "tools/jigsaws/converter.h"

namespace {

using prospect::tools::JigsawsOptions;

std::atomic<bool> stop{false};

const char* kHelp =
    R"(Reads a task of JIGSAWS, or videos in its layout, into one data set.

Read are ROOT/TASK/transcriptions/NAME.txt (lines 'FIRST LAST Gk', frames from 1) and
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

struct Arguments {
  JigsawsOptions options;
  std::string user;
};

void AddOptions(CLI::App* app, Arguments* a) {
  JigsawsOptions& o = a->options;
  app->add_option("--root", o.root, "folder that holds the task's folder")->required();
  app->add_option("--task", o.folder, "the task's folder")
      ->required()
      ->check(CLI::IsMember(prospect::model::jigsaws::TaskFolders()));
  app->add_option("--out", o.out, "the data set to write")->required();
  app->add_option("--every", o.every,
                  "keep one frame in so many, besides the first of each gesture and the last")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  auto* trials = app->add_option("--hold-out", o.hold_out.trials,
                                 "so many trials are held out for the figures, by a hash of "
                                 "their names")
                     ->check(CLI::Range(0, 1000))
                     ->capture_default_str();
  auto* names = app->add_option("--hold-out-trials", o.hold_out.names,
                                "these are held out instead, such as B001,C003")
                    ->delimiter(',')
                    ->excludes(trials);
  app->add_option("--hold-out-user", a->user, "this user's are held out instead, such as B")
      ->check([](const std::string& user) {
        return user.size() == 1 && user[0] >= 'A' && user[0] <= 'Z' ? ""
                                                                    : "must be a letter, A to Z";
      })
      ->excludes(trials)
      ->excludes(names);
  app->add_option("--valid", o.hold_out.valid,
                  "so many of the others only choose between settings, by the same hash")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
}

int Run(Arguments a) {
  if (!a.user.empty()) a.options.hold_out.user = a.user[0];
  std::signal(SIGINT, [](int) { stop = true; });
  std::signal(SIGTERM, [](int) { stop = true; });
  const auto say = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  const auto report = prospect::tools::ConvertJigsaws(a.options, say, &stop);
  std::printf("%zu trials, %lld frames in %s", report.trials, static_cast<long long>(report.frames),
              a.options.out.c_str());
  std::printf("; %zu repaired, %zu left out\n", report.repaired, report.left_out);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(kHelp);
  Arguments arguments;
  AddOptions(&app, &arguments);
  return prospect::tools::RunProgram("prospect-jigsaws", &app, argc, argv,
                                     [&] { return Run(arguments); });
}
