#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/exit_codes.h"

namespace prospect::tools {

/// How much of some work was done. Less than all of it only after Ctrl-C or TERM
/// (base/stop_signals.h): then programs tell and write what they have, say so, and end with
/// kExitInterrupted.
struct Extent {
  int done = 0;
  int wanted = 0;

  bool stopped() const { return done < wanted; }
  int exit_code() const { return stopped() ? kExitInterrupted : kExitSuccess; }
  /// "stopped after 3 of 100 scenes"; `what`: the counted things, plural.
  std::string Words(const std::string& what) const {
    return "stopped after " + std::to_string(done) + " of " + std::to_string(wanted) + " " + what;
  }
  /// The same as a line below a table; empty where all was done.
  std::string Line(const std::string& what) const { return stopped() ? Words(what) + "\n" : ""; }
  /// Into a report: "stopped", true or false, and "wanted".
  void Put(nlohmann::json* report) const {
    (*report)["stopped"] = stopped();
    (*report)["wanted"] = wanted;
  }
};

}  // namespace prospect::tools
