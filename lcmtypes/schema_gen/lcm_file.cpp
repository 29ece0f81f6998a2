#include "lcmtypes/schema_gen/lcm_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

namespace prospect::schema_gen {
namespace {

using Tokens = std::vector<std::string>;

bool IsWordLetter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

// Words (names and numbers) and single signs.
Tokens Split(const std::string& code) {
  Tokens tokens;
  bool in_word = false;
  for (const char c : code) {
    if (!IsWordLetter(c) || !in_word) tokens.emplace_back();
    tokens.back() += c;
    in_word = IsWordLetter(c);
    if (std::isspace(static_cast<unsigned char>(c))) tokens.pop_back();
  }
  return tokens;
}

bool IsWord(const std::string& token) { return IsWordLetter(token[0]); }

// Whether `tokens` read as `pattern`, where "*" stands for any word.
bool Reads(const Tokens& tokens, const Tokens& pattern) {
  if (tokens.size() != pattern.size()) return false;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (pattern[i] == "*" ? !IsWord(tokens[i]) : tokens[i] != pattern[i]) return false;
  }
  return true;
}

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
    const Tokens tokens = Split(code);
    if (Reads(tokens, {"{"})) return;
    if (Reads(tokens, {"}"}) || Reads(tokens, {"}", ";"})) {
      closed_ = true;
    } else if (Reads(tokens, {"package", "*", ";"})) {
      if (tokens[1] != "prospect") Fail("the package must be prospect");
    } else if (Reads(tokens, {"struct", "*"}) || Reads(tokens, {"struct", "*", "{"})) {
      if (!result_.name.empty()) Fail("one struct a file");
      result_.name = tokens[1];
    } else if (Reads(tokens, {"const", "*", "*", "=", "*", ";"})) {
      TakeConstant(tokens, comment);
    } else if (Reads(tokens, {"*", "*", ";"}) || Reads(tokens, {"*", "*", "[", "*", "]", ";"})) {
      TakeField(tokens, comment);
    } else {
      Fail("not understood: " + code);
    }
  }

  void TakeConstant(const Tokens& tokens, const std::string& comment) {
    result_.constants.push_back({tokens[1], tokens[2], tokens[4], comment});
    open_comment_ = &result_.constants.back().comment;
  }

  void TakeField(const Tokens& tokens, const std::string& comment) {
    const Field field{tokens[0], tokens[1], tokens.size() > 3 ? tokens[3] : "", comment};
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
