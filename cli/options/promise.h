#pragma once

#include <optional>

#include "cli/fwd.h"

namespace prospect::cli {

/// What is asked of refusals (model/refusal/promise.h): both, one or nothing.
struct PromiseOptions {
  std::optional<double> refuse_at_most;  ///< share of what can be done that may be refused
  std::optional<double> fail_at_most;    ///< share of what is attempted that may fail
  double delta = 0.1;                    ///< the second holds with probability 1 - delta

  bool asked() const { return refuse_at_most || fail_at_most; }
};

/// Adds --refuse-at-most (--alpha), --fail-at-most (--epsilon) and --delta.
void DefinePromise(CLI::App& app, PromiseOptions& promise);

}  // namespace prospect::cli
