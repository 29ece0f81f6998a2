#include "cli/options/search.h"

#include "cli/options/rule.h"
#include "cli/values.h"

namespace prospect::cli {

void DefineSamples(CLI::App& app, std::int64_t& samples) {
  app.add_option("--samples", samples, "rollouts a search")
      ->type_name("N")
      ->transform(Whole(1, 100'000'000))
      ->capture_default_str();
}

void DefineRecovery(CLI::App& app, int& retries, std::optional<double>& surprise) {
  app.add_option("--retries", retries,
                 "times a plan that is lost may be begun anew, where the task allows it")
      ->type_name("N")
      ->transform(Whole(0, 100))
      ->capture_default_str();
  app.add_option("--surprise", surprise,
                 "a plan is lost where a patch of the picture differs more than this from what was "
                 "imagined")
      ->default_str("0.3")
      ->type_name("X")
      ->check(Real(0, 1));
}

void DefineSearch(CLI::App& app, SearchOptions& search) {
  DefineSamples(app, search.samples);
  app.add_option("--workers", search.workers,
                 "workers that share each search, inside one process (the rollouts are of all)")
      ->type_name("N")
      ->transform(Whole(1, 256))
      ->capture_default_str();
  app.add_option("--depth", search.depth, "actions to look ahead; the plan's rest limits it")
      ->type_name("N")
      ->transform(Whole(1, 64))
      ->capture_default_str();
  DefineRule(app, search.rule);
  app.add_option("--v-failed", search.v_failed,
                 "a future whose V falls below this on the way is given up")
      ->default_str("0.02, with best_first 0")
      ->type_name("X")
      ->check(Real(0, 1));
  DefineRecovery(app, search.retries, search.surprise);
}

}  // namespace prospect::cli
