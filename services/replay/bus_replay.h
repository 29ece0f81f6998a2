#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "services/binding/shared_search.h"

namespace prospect::services {

/// A search as a log of the bus shows it.
struct ReplayedSearch {
  std::unique_ptr<SharedSearch> search;
  task_t task{};                             ///< as it was when the search began
  std::int64_t replies = 0, statistics = 0;  ///< messages of it in the log
};

/// Rebuilds every search in a log of the bus: its evaluations and its merged rows, byte for byte
/// what a listener held that heard the same messages (TableText). Messages that are no valid
/// message of ours are left out, as on the bus. Searches come in the order of their roots; of one
/// search the latest epoch.
/// @throws ExitError (kExitDataFile) when the file cannot be read
std::vector<ReplayedSearch> ReplayBusLog(const std::string& path);

}  // namespace prospect::services
