#pragma once

#include <string>

namespace prospect::cli {

/// The bus to use: --bus if given, else the environment's LCM_DEFAULT_URL, else the default.
std::string BusOf(const std::string& option);

/// Whether there is a route for a multicast bus. LCM's own failure without one is a null pointer
/// and a long message.
bool HasRoute(const std::string& bus);

/// @throws ExitError (kExitBus) with the commands that make a route
void RequireRoute(const std::string& bus);

/// From here on this process and what it starts have a bus that is nobody else's: a network
/// namespace of their own, or where none is allowed a port that nobody uses. Only while there are
/// no other threads. @return its URL @throws ExitError (kExitBus)
std::string EnterPrivateBus();

}  // namespace prospect::cli
