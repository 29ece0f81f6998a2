#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tasks/task_file.h"

namespace prospect::tasks {

/// The task files of one folder, NAME.yaml each: those of the installation, say.
class TaskFolder {
 public:
  explicit TaskFolder(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  /// Of all its files, those with a simulator first, each kind by the alphabet. Read at the first
  /// call; bad ones are left out. Throws TaskFileError: the folder is missing, no task or several
  /// are the usual one.
  const std::vector<TaskFile>& All() const;
  /// What is wrong with those that were left out, by the name of the file. Throws as All.
  const std::map<std::string, std::string>& Bad() const;
  /// The task of commands that name none. Throws as All.
  const TaskFile& Usual() const;
  /// Null: there is none of this name. Throws as All, and TaskFileError where its file is bad.
  const TaskFile* Find(const std::string& name) const;
  /// The JSON of a file's training settings: its own, or of the task that it names. Throws
  /// TaskFileError where there is no such task.
  std::string TrainingOf(const TaskFile& task) const;

 private:
  std::string path_;
  mutable std::vector<TaskFile> all_;
  mutable std::map<std::string, std::string> bad_;
};

/// Whether --task NAME|FILE means a file: it has a slash or ends with .yaml or .yml.
bool MeansFile(const std::string& name_or_file);

}  // namespace prospect::tasks
