#pragma once

#include <string>

namespace prospect::base {

/// Appends `line` and an end of line to a file that several processes share, which is made where it
/// is missing. A line is there whole or not at all: writers take turns, one that a killed writer
/// cut short is ended first (readers skip it), and where there is no room what was written is taken
/// back. Throws DiskError.
void AppendLine(const std::string& path, const std::string& line);

}  // namespace prospect::base
