#include "model/training/time_budget.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/atomic_file.h"

namespace prospect::model {

using nlohmann::json;

TimeBudget::TimeBudget(std::string path, double minutes, std::string key,
                       std::map<std::string, double> shares)
    : path_(std::move(path)), minutes_(minutes), key_(std::move(key)), shares_(std::move(shares)) {
  double sum = 0;
  for (const auto& [stage, share] : shares_) sum += share;
  for (auto& [stage, share] : shares_) share /= sum;
  std::ifstream in(path_);
  const json kept = json::parse(in, nullptr, false);
  if (!kept.is_object() || kept.value("minutes", 0.0) != minutes_ || kept.value("key", "") != key_)
    return;
  iterations_ = kept.value("iterations", iterations_);
}

std::int64_t TimeBudget::Iterations(const std::string& stage,
                                    const std::function<double()>& seconds) {
  const double time = 60 * minutes_ * shares_.at(stage);
  const auto known = iterations_.find(stage);
  if (known != iterations_.end()) return known->second;
  const double one = std::max(1e-6, seconds());
  iterations_[stage] = std::max<std::int64_t>(1, std::llround(time / one));
  Write();
  return iterations_[stage];
}

void TimeBudget::Write() const {
  const json kept = {{"minutes", minutes_}, {"key", key_}, {"iterations", iterations_}};
  base::WriteFile(path_, kept.dump(2) + "\n");
}

}  // namespace prospect::model
