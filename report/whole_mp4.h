#pragma once

#include <string>

namespace prospect::report {

/// Whether a file is an MPEG-4 container that was written to its end. Walks the boxes (four bytes
/// of length, four of name), which must fill the file exactly and hold the index ("moov") that is
/// written last.
bool IsWholeMp4(const std::string& path);

}  // namespace prospect::report
