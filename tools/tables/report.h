#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/tables/bootstrap.h"
#include "tools/tables/scorer.h"

namespace prospect::tools {

/// A line of both tables.
struct Line {
  std::string name;             ///< "L1+0.01C", "copy x", ...
  std::optional<Row> row;       ///< none: not trained
  bool is_model = false;        ///< else a baseline, which has neither iterations nor extras
  std::int64_t iterations = 0;  ///< of T
  double seconds = 0;           ///< of T's training; 0 = not known
};

/// One of the two tables as Markdown: a row a line, each figure with its 95 % interval.
std::string MarkdownTable(const std::vector<Line>& lines, bool successful_only);

/// Each other model less `reference`, on the same trials: labels and errors, of the successful
/// trials and of all, with 95 % intervals of the difference. Empty if there is no other.
std::string DifferencesTable(const std::vector<Line>& lines, const Line& reference);

/// Both tables as CSV: table, model, and for each column its value, the interval's ends and the
/// number of examples; empty fields where there is nothing.
std::string CsvTables(const std::vector<Line>& lines);

}  // namespace prospect::tools
