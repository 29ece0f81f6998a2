#include "tasks/action_table.h"

#include <algorithm>
#include <set>

#include "base/nearest.h"
#include "base/text.h"
#include "planner/path.h"
#include "tasks/names.h"

namespace prospect::tasks {
namespace {

constexpr int kMostActions = planner::kMaxActions;
constexpr std::size_t kMostCompared = 64;  // letters of a word that is looked for

void Require(const std::string& file, const YAML::Node& node, const std::string& what,
             const std::string& text, const std::string& defect) {
  if (!defect.empty()) FailAt(file, node, what + " " + Quoted(text) + " " + defect);
}

void RequireCount(const std::string& file, const YAML::Node& node, std::size_t count) {
  if (count >= 1 && count <= static_cast<std::size_t>(kMostActions)) return;
  FailAt(file, node,
         "actions: there are " + std::to_string(count) + ": name 1 to " +
             std::to_string(kMostActions) + (count == 0 ? "" : ", or give objects fewer names"));
}

std::vector<std::string> WordsOf(const Section& grid, const std::string& key) {
  std::vector<std::string> words;
  for (const YAML::Node& word : ListOf(grid.file(), grid.Need(key, "list them"), "a word")) {
    Require(grid.file(), word, "the name", word.Scalar(), WordDefect(word.Scalar()));
    if (std::find(words.begin(), words.end(), word.Scalar()) != words.end())
      FailAt(grid.file(), word, Quoted(word.Scalar()) + " is there twice: leave one out");
    words.push_back(word.Scalar());
  }
  return words;
}

}  // namespace

ActionTable::ActionTable(const std::string& file, const YAML::Node& node,
                         const std::vector<std::string>& objects)
    : file_(file) {
  if (node.IsSequence()) {
    ReadList(node);
  } else {
    ReadGrid(node, objects);
  }
  for (const sim::ActionSpec& action : actions_) {
    if (action.object.empty()) continue;
    if (std::find(objects_.begin(), objects_.end(), action.object) == objects_.end())
      objects_.push_back(action.object);
  }
}

void ActionTable::ReadGrid(const YAML::Node& node, std::vector<std::string> objects) {
  const Section grid(file_, node, "actions", {"kinds", "objects"});
  const std::vector<std::string> kinds = WordsOf(grid, "kinds"), own = WordsOf(grid, "objects");
  if (objects.empty()) objects = own;
  RequireCount(file_, node, kinds.size() * objects.size());
  for (const std::string& kind : kinds) {
    for (const std::string& object : objects) Add(node, kind + "(" + object + ")", kind, object);
  }
}

void ActionTable::ReadList(const YAML::Node& node) {
  RequireCount(file_, node, node.size());
  for (const YAML::Node& row : node) ReadRow(row);
}

void ActionTable::ReadRow(const YAML::Node& node) {
  if (node.IsScalar()) {
    Require(file_, node, "the action", node.Scalar(), ActionNameDefect(node.Scalar()));
    const NameParts parts = PartsOf(node.Scalar());
    return Add(node, node.Scalar(), parts.kind, parts.object);
  }
  const Section row(file_, node, "action", {"name", "kind", "object"});
  const std::string name = row.Text("name", "its name");
  Require(file_, node, "the action", name, ActionNameDefect(name));
  const NameParts parts = PartsOf(name);
  const auto phrase = [&](const char* key, const std::string& usual) {
    if (!row.Has(key)) return usual;
    const std::string text = row.Text(key, "a word or two");
    Require(file_, node, std::string("the ") + key, text, PhraseDefect(text));
    return text;
  };
  Add(node, name, phrase("kind", parts.kind), phrase("object", parts.object));
}

void ActionTable::Add(const YAML::Node& node, const std::string& name, const std::string& kind,
                      const std::string& object) {
  const bool twice = std::any_of(actions_.begin(), actions_.end(),
                                 [&](const sim::ActionSpec& other) { return other.name == name; });
  if (twice)
    FailAt(file_, node, "there are two actions " + Quoted(name) + ": give each a name of its own");
  if (name.size() > 64)
    FailAt(file_, node, "the action " + Quoted(name) + " is longer than 64: use shorter words");
  actions_.push_back({size(), name, kind, object});
}

std::vector<int> ActionTable::Meant(const std::string& word, const YAML::Node& where,
                                    int after) const {
  std::vector<int> meant;
  if (word == "any" || (word == "any_other" && after >= 0)) {
    for (int i = 0; i < size(); ++i) {
      if (word == "any" || i != after) meant.push_back(i);
    }
    return meant;
  }
  for (const sim::ActionSpec& action : actions_) {
    if (action.name == word) return {action.index};
    if (action.kind == word) meant.push_back(action.index);
  }
  return meant.empty() ? OfKind(word, where, after) : meant;
}

// kind(any), kind(same), kind(other).
std::vector<int> ActionTable::OfKind(const std::string& word, const YAML::Node& where,
                                     int after) const {
  const std::size_t open = word.rfind('(');
  if (open == std::string::npos || word.back() != ')') FailUnknown(word, where);
  const std::string kind = word.substr(0, open), object = word.substr(open);
  const bool same = object == "(same)", other = object == "(other)";
  if (!same && !other && object != "(any)") FailUnknown(word, where);
  if ((same || other) && after < 0)
    FailAt(file_, where,
           Quoted(word) + " says of nothing that it is the same or other: write " + kind +
               "(any), or name an object");
  std::vector<int> meant;
  bool known = false;
  for (const sim::ActionSpec& action : actions_) {
    if (action.kind != kind) continue;
    known = true;
    const bool equal =
        after >= 0 && action.object == actions_[static_cast<std::size_t>(after)].object;
    if ((!same && !other) || equal == same) meant.push_back(action.index);
  }
  if (!known) FailUnknown(word, where);
  return meant;
}

std::vector<int> ActionTable::AllMeant(const YAML::Node& words, int after) const {
  std::set<int> all;
  for (const YAML::Node& word : ListOf(file_, words, "an action, a kind or any")) {
    for (const int action : Meant(word.Scalar(), word, after)) all.insert(action);
  }
  return {all.begin(), all.end()};
}

void ActionTable::FailUnknown(const std::string& word, const YAML::Node& where) const {
  if (word.find('(') != std::string::npos && word.find(')') == std::string::npos)
    FailAt(file_, where,
           Quoted(word) +
               " ends before its ')': inside [ ] a comma ends a word, so put it in "
               "quotation marks");
  std::vector<std::string> known{"any", "any_other"};
  for (const sim::ActionSpec& action : actions_) {
    known.push_back(action.name);
    for (const char* object : {"", "(any)", "(same)", "(other)"})
      known.push_back(action.kind + object);
  }
  const std::string nearest = base::NearestWord(word.substr(0, kMostCompared), known);
  FailAt(file_, where,
         "there is no action or kind " + Quoted(word) +
             (nearest.empty() ? ": name one of 'actions', such as " + actions_.front().name
                              : "; did you mean '" + nearest + "'?"));
}

}  // namespace prospect::tasks
