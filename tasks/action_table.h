#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "planner/goal_fact.h"
#include "sim/task.h"
#include "tasks/section.h"

namespace prospect::tasks {

/// The actions of a task file and the words that rules say of them. Read once; const functions are
/// safe from any thread. All throw TaskFileError.
class ActionTable {
 public:
  /// @param node "actions" of the file: kinds and objects, or a list
  /// @param objects in the place of those beside kinds; empty: as the file has them
  ActionTable(const std::string& file, const YAML::Node& node,
              const std::vector<std::string>& objects = {});

  const std::vector<sim::ActionSpec>& actions() const { return actions_; }
  const std::vector<std::string>& objects() const { return objects_; }  ///< each once
  int size() const { return static_cast<int>(actions_.size()); }

  /// The actions that a word of a rule means, ascending: an action's name; a kind, or kind(any):
  /// all of that kind; any: all. With `after` (an action; -1: none), also kind(same) and
  /// kind(other): those of the kind about its object, or about another; and any_other: all but
  /// itself.
  /// @param where errors place it
  std::vector<int> Meant(const std::string& word, const YAML::Node& where, int after = -1) const;
  /// The same of a list of words, each action once.
  std::vector<int> AllMeant(const YAML::Node& words, int after = -1) const;

 private:
  void ReadGrid(const YAML::Node& node, std::vector<std::string> objects);
  void ReadList(const YAML::Node& node);
  void ReadRow(const YAML::Node& node);
  void Add(const YAML::Node& node, const std::string& name, const std::string& kind,
           const std::string& object);
  std::vector<int> OfKind(const std::string& word, const YAML::Node& where, int after) const;
  [[noreturn]] void FailUnknown(const std::string& word, const YAML::Node& where) const;

  std::string file_;
  std::vector<sim::ActionSpec> actions_;
  std::vector<std::string> objects_;
};

}  // namespace prospect::tasks
