#include "tasks/section.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/nearest.h"
#include "base/number_format.h"
#include "base/text.h"
#include "tasks/task_file.h"

namespace prospect::tasks {
namespace {

constexpr std::size_t kMostQuoted = 48;

int LineOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? 1 : mark.line + 1;
}

std::string KeyOf(const YAML::Node& key) { return key.IsScalar() ? key.Scalar() : "?"; }

}  // namespace

std::string Quoted(const std::string& text) {
  std::string quoted = text.substr(0, kMostQuoted);
  for (char& c : quoted) {
    if (c < ' ' || c == 0x7f) c = '?';
  }
  return "'" + quoted + (text.size() > kMostQuoted ? "...'" : "'");
}

void FailAt(const std::string& file, const YAML::Node& node, const std::string& what) {
  throw TaskFileError(file + ":" + std::to_string(LineOf(node)) + ": " + what);
}

Section::Section(std::string file, YAML::Node node, std::string name,
                 std::vector<std::string> known)
    : file_(std::move(file)), node_(std::move(node)), name_(std::move(name)) {
  if (!node_.IsMap())
    FailAt(file_, node_,
           (name_.empty() ? "the file" : name_) + " must be a map: lines of 'name: value', of " +
               base::Joined(known));
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = KeyOf(entry.first);
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      const std::string nearest = base::NearestWord(key, known);
      FailAt(file_, entry.first,
             "there is no " + Quoted(Name(key)) +
                 (nearest.empty() ? "; known: " + base::Joined(known)
                                  : "; did you mean '" + Name(nearest) + "'?"));
    }
    if (!seen.insert(key).second)
      FailAt(file_, entry.first, "'" + Name(key) + "' is there twice: leave one out");
  }
}

std::string Section::Name(const std::string& key) const {
  return name_.empty() ? key : name_ + "." + key;
}

bool Section::Has(const std::string& key) const { return static_cast<bool>(node_[key]); }

void Section::Fail(const std::string& key, const std::string& what) const {
  FailAt(file_, Has(key) ? node_[key] : node_, what);
}

YAML::Node Section::Need(const std::string& key, const std::string& remedy) const {
  const YAML::Node entry = node_[key];
  if (!entry || entry.IsNull()) Fail(key, "'" + Name(key) + "' is missing: " + remedy);
  return entry;
}

YAML::Node Section::Maybe(const std::string& key) const { return node_[key]; }

int Section::Whole(const std::string& key, int low, int high, const std::string& what) const {
  const YAML::Node entry = Need(key, "give " + what);
  int value = 0;
  const bool whole = entry.IsScalar() && YAML::convert<int>::decode(entry, value);
  if (!whole || value < low || value > high)
    Fail(key, Name(key) + " is " + (entry.IsScalar() ? Quoted(entry.Scalar()) : "a list or map") +
                  ": give " + what);
  return value;
}

std::string Section::Text(const std::string& key, const std::string& what) const {
  const YAML::Node entry = Need(key, "give " + what);
  if (!entry.IsScalar() || entry.Scalar().empty())
    Fail(key, Name(key) + " is no text: give " + what);
  return entry.Scalar();
}

bool Section::Flag(const std::string& key, bool usual) const {
  if (!Has(key)) return usual;
  bool value = false;
  if (!node_[key].IsScalar() || !YAML::convert<bool>::decode(node_[key], value))
    Fail(key, Name(key) + " is neither true nor false: give one of them");
  return value;
}

std::vector<YAML::Node> ListOf(const std::string& file, const YAML::Node& node,
                               const std::string& what) {
  if (node.IsScalar()) return {node};
  std::vector<YAML::Node> list;
  if (!node.IsSequence()) FailAt(file, node, "here " + what + " is wanted, or a list of such");
  for (const YAML::Node& one : node) {
    if (!one.IsScalar()) FailAt(file, one, "here " + what + " is wanted, no list or map");
    list.push_back(one);
  }
  return list;
}

double PositiveNumber(const std::string& file, const YAML::Node& node, const std::string& name,
                      double high) {
  double value = 0;
  const bool number = node.IsScalar() && YAML::convert<double>::decode(node, value);
  if (!number || !(value > 0 && value <= high))
    FailAt(file, node,
           name + " is " + (node.IsScalar() ? Quoted(node.Scalar()) : "a list or map") +
               ": give a number above 0, at most " + std::to_string(static_cast<long>(high)));
  return value;
}

}  // namespace prospect::tasks
