#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "sim/task_factory.h"

namespace prospect::tools {

// Tasks of one name by their objects, legs and tower, made when first needed: making one costs more
// than resetting it. Not thread-safe.
class SceneTasks {
 public:
  explicit SceneTasks(std::string name) : name_(std::move(name)) {}

  // Throws as sim::MakeTask. All other options must always be the same.
  sim::Task& Get(const sim::TaskOptions& options) {
    std::unique_ptr<sim::Task>& task = tasks_[{options.objects, options.legs, options.tower}];
    if (task == nullptr) task = sim::MakeTask(name_, options);
    return *task;
  }

 private:
  std::string name_;
  std::map<std::tuple<int, int, int>, std::unique_ptr<sim::Task>> tasks_;
};

}  // namespace prospect::tools
