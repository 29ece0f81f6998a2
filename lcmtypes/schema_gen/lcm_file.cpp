#include "lcmtypes/schema_gen/lcm_file.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace prospect::schema_gen {
namespace {

const std::regex kPackage(R"(package\s+(\w+)\s*;)");
const std::regex kStruct(R"(struct\s+(\w+)\s*\{?)");
const std::regex kConstant(R"(const\s+(\w+)\s+(\w+)\s*=\s*(-?\d+)\s*;)");
const std::regex kField(R"((\w+)\s+(\w+)\s*(?:\[\s*(\w+)\s*\])?\s*;)");

std::string Trim(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

void Append(std::string& text, const std::string& more) {
  if (more.empty()) return;
  if (!text.empty()) text += ' ';
  text += more;
}

// Holds what is known of the file so far and takes it line by line.
class Parser {
 public:
  explicit Parser(std::string path) : path_(std::move(path)) {}

  void Take(const std::string& line) {
    ++line_number_;
    const auto slashes = line.find("//");
    const std::string code = Trim(line.substr(0, slashes));
    std::string comment;
    if (slashes != std::string::npos) comment = Trim(line.substr(slashes + 2));
    if (code.empty()) return TakeComment(comment);
    TakeCode(code, comment);
  }

  Struct Finish() {
    if (!closed_) Fail("the struct does not end");
    return std::move(result_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(path_ + ":" + std::to_string(line_number_) + ": " + what);
  }

  // A comment line belongs to the struct until it opens, then to the entry above it.
  void TakeComment(const std::string& comment) { Append(*open_comment_, comment); }

  void TakeCode(const std::string& code, const std::string& comment) {
    std::smatch match;
    if (code == "{") return;
    if (code == "}" || code == "};") {
      closed_ = true;
    } else if (std::regex_match(code, match, kPackage)) {
      if (match[1] != "prospect") Fail("the package must be prospect");
    } else if (std::regex_match(code, match, kStruct)) {
      if (!result_.name.empty()) Fail("one struct a file");
      result_.name = match[1];
    } else if (std::regex_match(code, match, kConstant)) {
      TakeConstant(match, comment);
    } else if (std::regex_match(code, match, kField)) {
      TakeField(match, comment);
    } else {
      Fail("not understood: " + code);
    }
  }

  void TakeConstant(const std::smatch& match, const std::string& comment) {
    result_.constants.push_back({match[1], match[2], match[3], comment, result_.fields.size()});
    open_comment_ = &result_.constants.back().comment;
  }

  void TakeField(const std::smatch& match, const std::string& comment) {
    const Field field{match[1], match[2], match[3], comment};
    if (!field.count.empty()) RequireCount(field.count);
    result_.fields.push_back(field);
    open_comment_ = &result_.fields.back().comment;
  }

  void RequireCount(const std::string& count) const {
    const auto& fields = result_.fields;
    const bool known = std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
      return field.name == count && field.type == "int32_t" && field.count.empty();
    });
    if (!known) Fail("an array's size must be an int32_t field above it, not " + count);
  }

  std::string path_;
  int line_number_ = 0;
  bool closed_ = false;
  Struct result_;
  std::string* open_comment_ = &result_.comment;
};

}  // namespace

Struct ReadLcmFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  Parser parser(path);
  std::string line;
  while (std::getline(file, line)) parser.Take(line);
  return parser.Finish();
}

bool IsPrimitive(const std::string& type) {
  static const std::vector<std::string> kPrimitives = {
      "byte", "boolean", "int8_t", "int16_t", "int32_t", "int64_t", "float", "double", "string"};
  return std::find(kPrimitives.begin(), kPrimitives.end(), type) != kPrimitives.end();
}

}  // namespace prospect::schema_gen
