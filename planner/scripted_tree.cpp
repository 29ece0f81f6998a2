#include "planner/scripted_tree.h"

#include <algorithm>

namespace prospect::planner {
namespace {

// Which number of a node is drawn.
constexpr std::uint64_t kDrawStep = 11;
constexpr std::uint64_t kDrawBlur = 12;

// Uniform in [-1, 1), a multiple of 2^-52.
double Draw(std::uint64_t seed, std::uint64_t path_hash, std::uint64_t what) {
  const std::uint64_t bits = HashCombine(HashCombine(seed, path_hash), what) >> 11;
  return static_cast<double>(bits) / 4503599627370496.0 - 1.0;
}

double StepTo(std::uint64_t seed, std::uint64_t path_hash) {
  return ScriptedTree::kStep * Draw(seed, path_hash, kDrawStep);
}

float Hint(std::uint64_t seed, std::uint64_t child_hash, double parent_value) {
  const double hint = parent_value + StepTo(seed, child_hash) +
                      ScriptedTree::kBlur * Draw(seed, child_hash, kDrawBlur);
  return static_cast<float>(std::clamp(hint, 0.0, 1.0));
}

// Depth first, children in order of value, leaving out what cannot beat the best any more.
class BranchAndBound {
 public:
  explicit BranchAndBound(std::uint64_t seed) : seed_(seed) {}

  ScriptedTree::Optimum Run() {
    Below(kRootHash, 0.5);
    return best_;
  }

 private:
  struct Child {
    double value;
    int action;
  };

  void Below(std::uint64_t hash, double value) {
    const int left = ScriptedTree::kDepth - static_cast<int>(path_.size());
    if (left == 0 && value > best_.value) best_ = {value, path_};
    if (left == 0 || value + left * ScriptedTree::kStep <= best_.value) return;
    Child children[ScriptedTree::kBranching];
    for (int a = 0; a < ScriptedTree::kBranching; ++a) {
      children[a] = {value + StepTo(seed_, ExtendHash(hash, a)), a};
    }
    std::sort(std::begin(children), std::end(children),
              [](const Child& a, const Child& b) { return a.value > b.value; });
    for (const Child& child : children) {
      path_.push_back(static_cast<std::uint8_t>(child.action));
      Below(ExtendHash(hash, child.action), child.value);
      path_.pop_back();
    }
  }

  std::uint64_t seed_;
  Path path_;
  ScriptedTree::Optimum best_;
};

}  // namespace

double ScriptedTree::Value(const Path& path) const {
  double value = 0.5;
  std::uint64_t hash = kRootHash;
  for (const std::uint8_t action : path) {
    hash = ExtendHash(hash, action);
    value += StepTo(seed, hash);
  }
  return value;
}

Evaluation ScriptedTree::Evaluate(const Path& path) const {
  const double value = Value(path);
  const std::uint64_t hash = HashPath(path);
  Evaluation result;
  result.value = static_cast<float>(value);
  for (int a = 0; a < kBranching; ++a) {
    result.q.push_back(Hint(seed, ExtendHash(hash, a), value));
    result.p.push_back(1.0f);
  }
  return result;
}

ScriptedTree::Optimum ScriptedTree::FindOptimum() const { return BranchAndBound(seed).Run(); }

}  // namespace prospect::planner
