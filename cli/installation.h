#pragma once

#include <string>
#include <string_view>

namespace prospect::cli {

/// Where things lie, relative to the running program. In a build tree: programs in BUILD/bin, data
/// in the sources that BUILD was configured for. Installed: `prospect` in PREFIX/bin, programs in
/// PREFIX/lib/prospect or beside it, data in PREFIX/share/prospect.

/// Whether the running program lies in an installed tree.
bool IsInstalled();

/// How a person types it: "prospect" where it is installed, else "./prospect".
std::string TypedName();

/// A command as a person types it: Typed("up --open") is "./prospect up --open" in a checkout.
std::string Typed(std::string_view command);

/// The folder of the programs, without a slash at its end.
std::string ProgramsFolder();

/// A folder of data: "model/weights", "model/held_out", "config", "lcmtypes". What is not there is
/// named all the same: whoever opens it says what is missing.
std::string DataFolder(const std::string& name);

}  // namespace prospect::cli
