#include "base/nearest.h"

#include <algorithm>
#include <cstddef>

namespace prospect::base {
namespace {

// Damerau's distance, where neighbours that changed places count as one mistake.
std::size_t Mistakes(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = a[i - 1] != b[j - 1];
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + other});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

}  // namespace

std::string NearestWord(std::string_view typed, const std::vector<std::string>& known) {
  constexpr std::size_t kShortest = 3;  // of a beginning
  std::size_t fewest = std::max<std::size_t>(typed.size() / 3, 1) + 1;
  std::string nearest;
  for (const std::string& word : known) {
    std::size_t mistakes = Mistakes(typed, word);
    if (typed.size() >= kShortest && word.starts_with(typed)) mistakes = 1;
    if (mistakes >= fewest) continue;
    fewest = mistakes;
    nearest = word;
  }
  return nearest;
}

}  // namespace prospect::base
