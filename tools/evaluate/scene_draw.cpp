#include "tools/evaluate/scene_draw.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "tools/common/fork_map.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

constexpr int kPiece = 16;  // scenes a process asks about before it is seen whether they are enough

using Classes = std::vector<sim::SceneClass>;

// Of a program that is stopped, none.
Classes Ask(std::uint64_t first_seed, int count, int jobs, const std::function<ClassOf()>& set_up) {
  Classes classes(static_cast<std::size_t>(count));
  const Extent asked = ForkMap(
      count, jobs,
      [&]() {
        const ClassOf class_of = set_up();
        return [class_of, first_seed](int i) {
          return std::string(sim::ToString(class_of(first_seed + static_cast<std::uint64_t>(i))));
        };
      },
      [&](int i, const std::string& name) {
        classes[static_cast<std::size_t>(i)] = sim::SceneClassFromString(name);
      });
  return asked.stopped() ? Classes() : classes;
}

}  // namespace

std::vector<std::uint64_t> DrawScenes(const ScenesWanted& wanted, std::uint64_t first_seed,
                                      int jobs, const std::function<ClassOf()>& set_up, int most) {
  std::map<sim::SceneClass, int> missing = {{sim::SceneClass::kSolvable, wanted.solvable},
                                            {sim::SceneClass::kHopeless, wanted.hopeless}};
  std::vector<std::uint64_t> drawn;
  Progress progress("scenes drawn", wanted.total());
  const int piece = kPiece * std::max(1, jobs);
  const auto enough = [&] {
    return std::all_of(missing.begin(), missing.end(), [](const auto& m) { return m.second <= 0; });
  };
  for (int asked = 0; !enough(); asked += piece) {
    if (asked >= most) {
      throw std::runtime_error(std::to_string(most) + " scenes from " + std::to_string(first_seed) +
                               " do not hold as many solvable and hopeless ones");
    }
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(asked);
    const Classes classes = Ask(seed, piece, jobs, set_up);
    if (classes.empty()) break;
    for (std::size_t i = 0; i < classes.size(); ++i) {
      if (missing[classes[i]]-- <= 0) continue;
      drawn.push_back(seed + i);
      progress.Step();
    }
  }
  return drawn;
}

}  // namespace prospect::tools
