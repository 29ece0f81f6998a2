#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// What `./prospect verify` knows: the figures that docs/results.md gives for the bundled weights,
/// the commands that measure them, and how far a measurement may lie from them. Read from a YAML
/// file (config/figures.yaml, which describes its format). Plain values; no threads.
namespace prospect::verify {

/// One figure of a report. `quick` is what the smaller run of the same command gives, `full` what
/// docs/results.md states.
struct Figure {
  std::string name;
  std::string pointer;  ///< JSON pointer into the report, such as /labels/x1/second
  double quick = 0, full = 0;
  double tolerance = 0;           ///< largest distance allowed, either way
  std::optional<double> at_most;  ///< instead of the three above: a bound, for times
  std::string printed;            ///< as docs/results.md prints it
};

/// One command and what is read from the report that it writes.
struct Measurement {
  std::string name;
  std::vector<std::vector<std::string>> commands;  ///< run in this order; the last one reports
  std::map<std::string, std::string> quick, full;  ///< values of {placeholders} in the commands
  std::vector<Figure> figures;
};

/// Throws std::invalid_argument, naming file and place, if the file is not as described.
std::vector<Measurement> ReadMeasurements(const std::string& path);

/// A command with {names} replaced. Throws std::invalid_argument on a name that has no value.
std::vector<std::string> Fill(const std::vector<std::string>& command,
                              const std::map<std::string, std::string>& values);

/// A figure beside its measurement.
struct Verdict {
  double measured = 0;
  double expected = 0;  ///< the bound for a figure with at_most
  bool within = false;
};

/// Throws std::invalid_argument if the report has no such number.
Verdict Judge(const Figure& figure, bool full, const nlohmann::json& report);

}  // namespace prospect::verify
