#pragma once

#include <string>

namespace prospect::services {

/// How a line of a log looks, for spdlog.
inline constexpr char kLogPattern[] = "%H:%M:%S.%e %^%-5l%$ %n: %v";

/// Sets up spdlog's default logger for this process: one line an event on stderr, as "time LEVEL
/// component: text". Use spdlog::info("...") and its kin afterwards; stdout stays free for results.
/// @param component the program's short name, such as "worker"
/// @param level trace, debug, info, warn, error or off
/// @throws std::runtime_error that lists the levels when `level` is none of them
void SetUpLog(const std::string& component, const std::string& level);

}  // namespace prospect::services
