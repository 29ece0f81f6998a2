#include "cli/commands/collect.h"

#include "cli/options/common.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

void DefineVideos(CLI::App& app, CollectOptions& options) {
  app.add_option("--fps", options.frames_per_second,
                 "jigsaws: frames a second, a divisor of 30 (JIGSAWS has 30)")
      ->type_name("N")
      ->transform(Whole(1, 30))
      ->capture_default_str();
  app.add_option("--width", options.width, "jigsaws: pixels (JIGSAWS has 640)")
      ->type_name("N")
      ->transform(Whole(32, 1920))
      ->capture_default_str();
  app.add_option("--height", options.height, "jigsaws: pixels (JIGSAWS has 480)")
      ->type_name("N")
      ->transform(Whole(24, 1080))
      ->capture_default_str();
  app.add_flag("--right-eye", options.right_eye, "jigsaws: write NAME_capture2.avi, too");
  app.add_flag("--failures", options.failures,
               "jigsaws: keep trials that fail; otherwise they are done again until they succeed, "
               "as JIGSAWS has none");
}

}  // namespace

void Define(CLI::App& app, CollectOptions& options) {
  DefineTask(app, options.task, Tasks::kSimulated);
  app.add_option("--format", options.format,
                 "hdf5: a data set; jigsaws: SIMULATED suturing videos and transcriptions in the "
                 "layout of JIGSAWS")
      ->type_name("NAME")
      ->check(OneOf({"hdf5", "jigsaws"}))
      ->capture_default_str();
  app.add_option("--trials", options.trials, "number of trials")
      ->default_str("100; jigsaws: 1 to 39, default 39")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000));
  DefineSeed(app, options.seed, "of the first trial; trial i has seed + i, at most 999999");
  DefineOut(app, options.out, "the data set to write (HDF5); jigsaws: a folder", "FILE")
      ->required();
  DefineTrialScenes(app, options.scenes);
  DefineJobs(app, options.jobs);
  DefineShard(app, options.shard);
  app.add_option("--image-noise", options.image_noise,
                 "sigma of the sensor noise that readers add (jigsaws: that is in the pictures), a "
                 "share of full range")
      ->type_name("X")
      ->check(Real(0, 0.25))
      ->capture_default_str();
  app.add_option("--foresight", options.foresight,
                 "share of the choices that are tried out beforehand, with what has to follow: one "
                 "that fails then is drawn anew, so that more trials get far, and fail late")
      ->type_name("X")
      ->check(Real(0, 1))
      ->capture_default_str();
  DefineVideos(app, options);
  app.add_flag("--resume", options.resume, "go on with the trials that an earlier run left");
  app.add_flag("--keep-parts", options.keep_parts, "keep the files of single trials");
  DefineReport(app, options.report);
}

std::string Defect(const CollectOptions& options) {
  if (options.format == "jigsaws" && !TaskOf(options.task).only_predicted)
    return "--format jigsaws is for tasks that are only predicted, such as --task suturing";
  if (options.format == "jigsaws" && options.shard.given()) return "--shard is for --format hdf5";
  return "";
}

}  // namespace prospect::cli
