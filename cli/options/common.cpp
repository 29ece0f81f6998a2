#include "cli/options/common.h"

#include "cli/values.h"

namespace prospect::cli {

void DefineJobs(CLI::App& app, int& jobs) {
  app.add_option("--jobs", jobs, "processes that share the work")
      ->type_name("N")
      ->transform(Whole(1, 256))
      ->capture_default_str();
}

void DefineThreads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "CPU threads of the networks")
      ->type_name("N")
      ->transform(Whole(1, 256))
      ->capture_default_str();
}

void DefineSeed(CLI::App& app, std::uint64_t& seed, const std::string& what, std::uint64_t least) {
  app.add_option("--seed", seed, what)
      ->type_name("N")
      ->transform(Whole(static_cast<std::int64_t>(least), 999'999'999'999'999'999))
      ->capture_default_str();
}

void DefineScenes(CLI::App& app, int& scenes, const std::string& what, int least, int most) {
  app.add_option("--scenes", scenes, what)
      ->type_name("N")
      ->transform(Whole(least, most))
      ->capture_default_str();
}

CLI::Option* DefineOut(CLI::App& app, std::string& out, const std::string& what,
                       const std::string& type) {
  return app.add_option("--out", out, what)->type_name(type);
}

}  // namespace prospect::cli
