#include "cli/commands/view.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace prospect::cli {
namespace {

std::string SizeDefect(const std::string& text) {
  int width = 0, height = 0;
  char end = 0;
  const bool read = std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &end) == 2;
  return read ? "" : "is '" + text + "': give WIDTHxHEIGHT";
}

}  // namespace

void Define(CLI::App& app, ViewOptions& options) {
  app.description(
      "A picture of a task's scene, at any size and from any of its cameras, for people. With "
      "--actions, after these actions; with --frames or --video, of every tick on the way. With "
      "--episode scene and actions are those of an episode that was carried out: worlds repeat bit "
      "for bit, so what is shown is what happened");
  DefineTask(app, options.task, Tasks::kSimulated);
  DefineSeed(app, options.seed, "the scene");
  DefineScene(app, options.scene);
  app.add_option("--episode", options.episode,
                 "an episode's result.json: task, scene and actions are taken from there")
      ->type_name("FILE");
  app.add_option("--actions", options.actions, "carry these actions out first: 0,4,8")
      ->type_name("LIST")
      ->delimiter(',');
  app.add_option("--size", options.size, "pixels")
      ->type_name("WIDTHxHEIGHT")
      ->check(CLI::Validator(SizeDefect, ""))
      ->capture_default_str();
  app.add_option("--camera", options.camera, "one of the scene's cameras")
      ->default_str("view, or the only one")
      ->type_name("NAME");
  DefineOut(app, options.out, "the picture to write (PNG)", "FILE");
  app.add_option("--frames", options.frames,
                 "a folder for a picture of every tick, 00000.png and so on")
      ->type_name("DIR");
  app.add_option("--video", options.video, "a video of every tick to write (MP4)")
      ->type_name("FILE");
  DefineQuiet(app, options.quiet);
}

std::string Defect(const ViewOptions& options) {
  if (options.out.empty() && options.frames.empty() && options.video.empty())
    return "nothing to write: give --out, --frames or --video";
  return options.episode.empty() ? SceneDefect(options.scene, options.task) : "";
}

}  // namespace prospect::cli
