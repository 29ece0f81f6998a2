// A model whose answers are written down path by path, for trees small enough to work out by hand.
#pragma once

#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/model_source.h"

namespace prospect::planner {

class TableModel : public ModelSource {
 public:
  void Set(const Path& path, float value, float done, std::vector<float> q, std::vector<float> p) {
    table_[path] = {value, done, std::move(q), std::move(p)};
  }
  Evaluation& At(const Path& path) { return table_.at(path); }

  Evaluation Evaluate(const Path& path) override {
    asked.push_back(path);
    const auto found = table_.find(path);
    if (found == table_.end()) throw std::runtime_error("nobody should ask for " + ToString(path));
    return found->second;
  }

  std::vector<Path> asked;

 private:
  std::map<Path, Evaluation> table_;
};

// Two actions, each taken once; worked out by hand in algorithm_test.cpp.
inline TableModel TwoActionModel() {
  TableModel model;
  model.Set({}, 0.5f, 1.0f, {0.4f, 0.2f}, {1, 1});
  model.Set({0}, 0.8f, 0.9f, {0.0f, 0.5f}, {1, 1});
  model.Set({1}, 0.6f, 0.8f, {0.7f, 0.0f}, {1, 1});
  model.Set({0, 1}, 0.5f, 0.5f, {0, 0}, {1, 1});
  model.Set({1, 0}, 0.9f, 0.9f, {0, 0}, {1, 1});
  return model;
}

}  // namespace prospect::planner
