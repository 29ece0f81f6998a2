#include "tasks/task_folder.h"

#include <algorithm>
#include <filesystem>

#include "base/text.h"

namespace prospect::tasks {
namespace {

namespace fs = std::filesystem;

void RequireOneUsual(const std::string& folder, const std::vector<TaskFile>& all) {
  std::vector<std::string> usual;
  for (const TaskFile& task : all) {
    if (task.usual) usual.push_back(task.path);
  }
  if (usual.size() > 1)
    throw TaskFileError("'default: true' stands in " + base::Joined(usual, " and ") +
                        ": leave it in one");
  if (usual.empty())
    throw TaskFileError("no task file in " + folder + " says 'default: true': let one say so");
}

// Of the name that the file has.
TaskFile ReadNamed(const fs::path& path) {
  TaskFile task = ReadTaskFile(path.string());
  const std::string& name = task.spec.name;
  if (name != path.stem())
    throw TaskFileError(task.path + ": its task is named '" + name + "': name the file " + name +
                        ".yaml");
  return task;
}

}  // namespace

const std::vector<TaskFile>& TaskFolder::All() const {
  if (!all_.empty()) return all_;
  std::error_code error;
  std::vector<TaskFile> all;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    if (entry.path().extension() != ".yaml") continue;
    try {
      all.push_back(ReadNamed(entry.path()));
    } catch (const TaskFileError& bad) {
      bad_[entry.path().stem()] = bad.what();
    }
  }
  if (error) throw TaskFileError("no task files in " + path_ + ": is the installation whole?");
  RequireOneUsual(path_, all);
  std::sort(all.begin(), all.end(), [](const TaskFile& a, const TaskFile& b) {
    const bool simulated = a.simulator.has_value();
    return simulated != b.simulator.has_value() ? simulated : a.spec.name < b.spec.name;
  });
  all_ = std::move(all);
  return all_;
}

const std::map<std::string, std::string>& TaskFolder::Bad() const {
  All();
  return bad_;
}

const TaskFile& TaskFolder::Usual() const {
  const auto usual =
      std::find_if(All().begin(), All().end(), [](const TaskFile& task) { return task.usual; });
  return *usual;
}

const TaskFile* TaskFolder::Find(const std::string& name) const {
  for (const TaskFile& task : All()) {
    if (task.spec.name == name) return &task;
  }
  const auto bad = bad_.find(name);
  if (bad != bad_.end()) throw TaskFileError(bad->second);
  return nullptr;
}

std::string TaskFolder::TrainingOf(const TaskFile& task) const {
  if (task.training_of.empty()) return task.training;
  const TaskFile* other = Find(task.training_of);
  if (other == nullptr || !other->training_of.empty())
    throw TaskFileError(task.path + ":" + std::to_string(task.training_line) +
                        ": there is no task '" + task.training_of +
                        "' with training settings of its own: name one that "
                        "'prospect tasks' lists, or give settings");
  return other->training;
}

bool MeansFile(const std::string& name_or_file) {
  return name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".yaml") ||
         name_or_file.ends_with(".yml");
}

}  // namespace prospect::tasks
