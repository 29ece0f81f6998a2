#include "tools/common/causes.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace prospect::tools {
namespace {

using Counts = std::vector<std::pair<std::string, int>>;

Counts MostFrequentFirst(const std::map<std::string, int>& counts) {
  Counts sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

}  // namespace

std::string CauseOf(const std::string& reason) { return reason.substr(0, reason.find('(')); }

std::map<std::string, int> ByCause(const std::map<std::string, int>& reasons) {
  std::map<std::string, int> causes;
  for (const auto& [reason, count] : reasons) causes[CauseOf(reason)] += count;
  return causes;
}

void PrintCauses(const std::map<std::string, int>& reasons, int trials, std::FILE* out) {
  for (const auto& [cause, total] : MostFrequentFirst(ByCause(reasons))) {
    std::fprintf(out, "  %-24s %6d  (%.1f %%)\n", cause.c_str(), total, 100.0 * total / trials);
    std::map<std::string, int> within;
    for (const auto& [reason, count] : reasons) {
      if (CauseOf(reason) == cause) within[reason] = count;
    }
    if (within.size() < 2) continue;
    for (const auto& [reason, count] : MostFrequentFirst(within)) {
      std::fprintf(out, "    %-22s %6d\n", reason.c_str(), count);
    }
  }
}

}  // namespace prospect::tools
