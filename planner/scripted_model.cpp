#include "planner/scripted_model.h"

namespace prospect::planner {
namespace {

// Which number of a node is drawn; actions are counted on from kQ and kP.
constexpr std::uint64_t kValue = 1;
constexpr std::uint64_t kHopeless = 2;
constexpr std::uint64_t kDone = 3;
constexpr std::uint64_t kFailing = 4;
constexpr std::uint64_t kQ = 1000;
constexpr std::uint64_t kP = 2000;
constexpr std::uint64_t kForbidden = 3000;

}  // namespace

double ScriptedModel::Uniform(std::uint64_t path_hash, std::uint64_t what) const {
  const std::uint64_t bits = HashCombine(HashCombine(parameters_.seed, path_hash), what);
  return static_cast<double>(bits >> 11) / 9007199254740992.0;  // 2^53
}

double ScriptedModel::Value(std::uint64_t path_hash) const {
  const double u = Uniform(path_hash, kValue);
  return Uniform(path_hash, kHopeless) < parameters_.hopeless ? 0.09 * u : 0.11 + 0.88 * u;
}

Evaluation ScriptedModel::Evaluate(const Path& path) {
  ++evaluations_;
  const std::uint64_t hash = HashPath(path);
  Evaluation result;
  result.value = static_cast<float>(Value(hash));
  const double done = Uniform(hash, kDone);
  const bool failing = Uniform(hash, kFailing) < parameters_.failing;
  result.done = static_cast<float>(failing ? 0.09 * done : 0.5 + 0.5 * done);
  for (int a = 0; a < parameters_.num_actions; ++a) {
    const auto action = static_cast<std::uint64_t>(a);
    const double hint = Value(ExtendHash(hash, a));
    const bool forbidden = Uniform(hash, kForbidden + action) < parameters_.forbidden;
    const double p = Uniform(hash, kP + action);
    result.q.push_back(static_cast<float>(0.6 * hint + 0.4 * Uniform(hash, kQ + action)));
    result.p.push_back(static_cast<float>(forbidden ? 0.009 * p : 0.5 + 0.5 * p));
  }
  return result;
}

}  // namespace prospect::planner
