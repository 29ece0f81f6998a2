#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace prospect::tasks {

/// A text from a file as an error may quote it: short, printable, in quotation marks.
std::string Quoted(const std::string& text);

/// Throws TaskFileError "FILE:LINE: what".
[[noreturn]] void FailAt(const std::string& file, const YAML::Node& node, const std::string& what);

/// A map of a task file, which knows where it stands: what is wrong with an entry is told with file
/// and line. All functions throw TaskFileError.
class Section {
 public:
  /// Refuses what is no map, entries that none of `known` names (with the nearest one that does),
  /// and entries that are there twice. @param name as errors call it: "picture"; empty: the file
  Section(std::string file, YAML::Node node, std::string name, std::vector<std::string> known);

  const std::string& file() const { return file_; }
  bool Has(const std::string& key) const;
  /// The entry; without it, `remedy` says what is to be written.
  YAML::Node Need(const std::string& key, const std::string& remedy) const;
  YAML::Node Maybe(const std::string& key) const;

  /// `what`: what is asked for, in words ("a whole number from 1 to 64").
  int Whole(const std::string& key, int low, int high, const std::string& what) const;
  std::string Text(const std::string& key, const std::string& what) const;
  bool Flag(const std::string& key, bool usual) const;

  /// Throws with the line of the entry, or of the section where it has none.
  [[noreturn]] void Fail(const std::string& key, const std::string& what) const;
  /// "picture.width".
  std::string Name(const std::string& key) const;

 private:
  std::string file_;
  YAML::Node node_;
  std::string name_;
};

/// A scalar, or the scalars of a list. @param what as in Section::Whole; throws TaskFileError
std::vector<YAML::Node> ListOf(const std::string& file, const YAML::Node& node,
                               const std::string& what);

/// A number of a scalar, above 0 and at most `high`. Throws TaskFileError
double PositiveNumber(const std::string& file, const YAML::Node& node, const std::string& name,
                      double high);

}  // namespace prospect::tasks
