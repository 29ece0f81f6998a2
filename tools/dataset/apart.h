#pragma once

#include <functional>
#include <string>

namespace prospect::tools {

/// Runs `work` in a child, since libhdf5 crashes on some damaged files (its H5Ocopy above all).
/// @return its status; kExitDataFile, told on standard error, where it crashed; then what it left
/// of `out` half written is removed (empty: it writes nothing)
int RunApart(const std::function<int()>& work, const std::string& out);

}  // namespace prospect::tools
