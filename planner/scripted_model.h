// A model whose every number is a pure function of (seed, path), so that whole expected trees can
// be written down without weights. Used by tests and benchmarks. Stateless but for the count; not
// thread safe.
#pragma once

#include <cstdint>

#include "planner/model_source.h"

namespace prospect::planner {

struct ScriptedModelParameters {
  int num_actions = 4;
  std::uint64_t seed = 0;
  double failing = 0.2;    // share of nodes with f below 0.1
  double hopeless = 0.1;   // share of nodes with V below 0.1
  double forbidden = 0.1;  // share of actions with p below 0.01
};

class ScriptedModel : public ModelSource {
 public:
  explicit ScriptedModel(const ScriptedModelParameters& parameters) : parameters_(parameters) {}
  // V in [0, 1), Q in [0, 1) and related to the child's V, so that a search has something to find.
  Evaluation Evaluate(const Path& path) override;
  std::int64_t evaluations() const { return evaluations_; }  // calls of Evaluate

 private:
  double Uniform(std::uint64_t path_hash, std::uint64_t what) const;
  double Value(std::uint64_t path_hash) const;

  ScriptedModelParameters parameters_;
  std::int64_t evaluations_ = 0;
};

}  // namespace prospect::planner
