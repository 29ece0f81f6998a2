#include "tools/verify/tables.h"

#include <algorithm>
#include <sstream>

namespace prospect::verify {
namespace {

struct Table {
  std::string heading, text;
  std::vector<std::string> rows;
};

std::vector<Table> TablesOf(const std::string& markdown) {
  std::vector<Table> tables;
  std::istringstream in(markdown);
  std::string heading;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#")) heading = line.substr(line.find_first_not_of("# "));
    const bool row = line.starts_with("|");
    if (row && !inside) tables.push_back({heading, "", {}});
    if (row) tables.back().text += line + "\n", tables.back().rows.push_back(line);
    inside = row;
  }
  return tables;
}

std::string Trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

// The first cell that is not empty of its heading row.
std::string TitleOf(const Table& table) {
  std::istringstream cells(table.rows.front().substr(1));
  for (std::string cell; std::getline(cells, cell, '|');) {
    const std::string title = Trimmed(cell);
    if (!title.empty()) return table.heading + ": " + title;
  }
  return table.heading;
}

bool Prints(const Table& table, const std::vector<Measurement>& measurements) {
  return std::any_of(measurements.begin(), measurements.end(), [&](const Measurement& measured) {
    return std::any_of(measured.figures.begin(), measured.figures.end(), [&](const Figure& figure) {
      return table.text.find(figure.printed) != std::string::npos;
    });
  });
}

}  // namespace

std::vector<std::string> TablesNotMeasured(const std::string& markdown,
                                           const std::vector<Measurement>& measurements) {
  std::vector<std::string> names;
  for (const Table& table : TablesOf(markdown))
    if (!Prints(table, measurements)) names.push_back(TitleOf(table));
  return names;
}

}  // namespace prospect::verify
