#include "model/segments/transcription.h"

#include <fstream>
#include <sstream>

#include "model/dataset.h"

namespace prospect::model::segments {
namespace {

constexpr std::size_t kLongestLine = 200;

Span ParseLine(const std::string& path, int number, const std::string& line,
               const std::vector<std::string>& names) {
  std::istringstream in(line);
  Span span;
  std::string action, rest, why;
  if (line.size() > kLongestLine || !(in >> span.first >> span.last >> action) || in >> rest)
    FailAtLine(path, number, "is not of the form 'FIRST LAST ACTION'");
  span.action = ActionOf(action, names, &why);
  if (span.action < 0) FailAtLine(path, number, why);
  --span.first;
  --span.last;
  span.line = number;
  return span;
}

}  // namespace

Segmentation ReadTranscription(const std::string& path, const std::vector<std::string>& names) {
  std::ifstream in(path);
  std::vector<Span> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    rows.push_back(ParseLine(path, number, line, names));
  }
  if (in.bad() || !in.eof()) throw DataError(path + ": cannot be read");
  return InOrder(std::move(rows), path);
}

}  // namespace prospect::model::segments
