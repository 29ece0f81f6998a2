#include "model/segments/segment_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>

#include "model/dataset.h"

namespace prospect::model::segments {
namespace {

constexpr std::size_t kLongestLine = 1000;
constexpr double kLatest = 1e6;  // seconds or frames: eleven days

using Cells = std::vector<std::string>;

std::string Trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// A doubled quotation mark inside quotation marks stands for one.
Cells CellsOf(const std::string& line) {
  Cells cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool mark = line[i] == '"';
    if (mark && quoted && line.substr(i + 1, 1) == "\"") {
      cells.back() += line[++i];
    } else if (mark) {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  for (std::string& cell : cells) cell = Trimmed(cell);
  return cells;
}

bool ReadTime(const std::string& text, double* time) {
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, *time);
  return error == std::errc() && rest == end && std::isfinite(*time) && *time >= 0 &&
         *time <= kLatest;
}

bool ReadVerdict(std::string text, bool* succeeded) {
  for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  *succeeded = text == "1" || text == "yes" || text == "true";
  return *succeeded || text == "0" || text == "no" || text == "false";
}

/// Rows of one file; `columns` names them, `before` of them stand before "start".
class Reader {
 public:
  Reader(const std::string& path, const std::vector<std::string>& names, std::size_t before)
      : path_(path), names_(names), before_(before) {}

  void Each(const std::function<void(const Cells&, const CsvRow&)>& take) const {
    std::ifstream in(path_);
    std::string line;
    bool first = true;
    for (int number = 1; std::getline(in, line); ++number) {
      const std::string text = Trimmed(WithoutMark(line, number));
      if (text.empty() || text.front() == '#') continue;
      if (line.size() > kLongestLine) FailAtLine(path_, number, "is longer than a row can be");
      const Cells cells = CellsOf(text);
      if (!(first && IsHeader(cells))) take(cells, RowOf(cells, number));
      first = false;
    }
    if (in.bad() || !in.eof()) throw DataError(path_ + ": cannot be read");
  }

 private:
  // Spreadsheets begin a file with a byte order mark.
  static std::string WithoutMark(const std::string& line, int number) {
    return number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0 ? line.substr(3) : line;
  }

  bool IsHeader(const Cells& cells) const {
    return cells.size() > before_ && cells[before_].rfind("start", 0) == 0;
  }

  CsvRow RowOf(const Cells& cells, int number) const {
    if (cells.size() < before_ + 4 || cells.size() > before_ + 5)
      FailAtLine(path_, number,
                 std::string("is not of the form '") + (before_ > 0 ? "demo," : "") +
                     "start,end,action,succeeded' with perhaps a cause");
    CsvRow row;
    row.line = number;
    const std::string* cell = &cells[before_];
    if (!ReadTime(cell[0], &row.start) || !ReadTime(cell[1], &row.end))
      FailAtLine(path_, number, "start and end are numbers from 0");
    std::string why;
    row.action = ActionOf(cell[2], names_, &why);
    if (row.action < 0) FailAtLine(path_, number, why);
    if (!ReadVerdict(cell[3], &row.succeeded))
      FailAtLine(path_, number, "whether it succeeded is 1 or 0, yes or no, true or false");
    if (cells.size() > before_ + 4) row.cause = cells[before_ + 4];
    return row;
  }

  const std::string& path_;
  const std::vector<std::string>& names_;
  std::size_t before_;
};

Span SpanOf(const CsvRow& row, double frames_per_unit) {
  Span span;
  span.first = static_cast<int>(std::lround(row.start * frames_per_unit));
  span.last = static_cast<int>(std::lround(row.end * frames_per_unit));
  span.action = row.action;
  span.succeeded = row.succeeded;
  if (!row.succeeded) span.cause = row.cause;
  span.line = row.line;
  return span;
}

}  // namespace

std::vector<CsvRow> ReadSegmentCsv(const std::string& path, const std::vector<std::string>& names) {
  std::vector<CsvRow> rows;
  Reader(path, names, 0).Each([&](const Cells&, const CsvRow& row) { rows.push_back(row); });
  return rows;
}

std::map<std::string, std::vector<CsvRow>> ReadDemoCsv(const std::string& path,
                                                       const std::vector<std::string>& names) {
  std::map<std::string, std::vector<CsvRow>> rows;
  Reader(path, names, 1).Each([&](const Cells& cells, const CsvRow& row) {
    rows[cells[0]].push_back(row);
  });
  if (rows.empty()) throw DataError(path + ": holds no row");
  return rows;
}

Segmentation FromSeconds(const std::vector<CsvRow>& rows, double frames_per_second,
                         const std::string& path) {
  std::vector<Span> spans;
  for (const CsvRow& row : rows) {
    Span span = SpanOf(row, frames_per_second);
    const bool touched = std::any_of(rows.begin(), rows.end(), [&](const CsvRow& other) {
      return other.start > row.start && other.start == row.end;
    });
    if (touched && span.last > span.first) --span.last;
    spans.push_back(span);
  }
  return InOrder(std::move(spans), path);
}

Segmentation FromFrames(const std::vector<CsvRow>& rows, const std::string& path) {
  std::vector<Span> spans;
  for (const CsvRow& row : rows) spans.push_back(SpanOf(row, 1));
  return InOrder(std::move(spans), path);
}

}  // namespace prospect::model::segments
