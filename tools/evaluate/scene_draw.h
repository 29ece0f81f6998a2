#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sim/oracle.h"

namespace prospect::tools {

// How many scenes of each class are wanted; doubtful ones on the way are left out.
struct ScenesWanted {
  int solvable = 0;
  int hopeless = 0;
  int total() const { return solvable + hopeless; }
};

// What the oracle says of one scene.
using ClassOf = std::function<sim::SceneClass(std::uint64_t scene_seed)>;

// The first scenes of each class from `first_seed` on, in seed order, as many as wanted. The oracle
// is asked by `jobs` processes that each set themselves up once; its answers are to be kept by
// whoever gives them. Fewer where the program is stopped (ForkMap). Throws std::runtime_error when
// `most` seeds do not hold them, and as ForkMap.
std::vector<std::uint64_t> DrawScenes(const ScenesWanted& wanted, std::uint64_t first_seed,
                                      int jobs, const std::function<ClassOf()>& set_up,
                                      int most = 100'000);

}  // namespace prospect::tools
