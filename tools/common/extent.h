#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace prospect::tools {

constexpr int kExitInterrupted = 130;

/// How much of some work was done. Less than all of it only after Ctrl-C or TERM
/// (base/stop_signals.h): then programs tell and write what they have, say so, and end with 130.
struct Extent {
  int done = 0;
  int wanted = 0;

  bool stopped() const { return done < wanted; }
  int exit_code() const { return stopped() ? kExitInterrupted : 0; }
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

/// Work that is worth nothing by halves was stopped; the message says how far it came. Exit code
/// 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace prospect::tools
