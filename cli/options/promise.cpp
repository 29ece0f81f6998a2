#include "cli/options/promise.h"

#include "cli/values.h"

namespace prospect::cli {

void DefinePromise(CLI::App& app, PromiseOptions& promise) {
  app.add_option("--refuse-at-most,--alpha", promise.refuse_at_most,
                 "plans are refused so that at most this share of what can be done is")
      ->type_name("SHARE")
      ->check(Share());
  app.add_option("--fail-at-most,--epsilon", promise.fail_at_most,
                 "plans are refused so that at most this share of what is attempted fails, with "
                 "probability 1 - delta")
      ->type_name("SHARE")
      ->check(Share());
  app.add_option("--delta", promise.delta, "see --fail-at-most")
      ->type_name("SHARE")
      ->check(Share())
      ->capture_default_str();
}

}  // namespace prospect::cli
