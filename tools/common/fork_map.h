#pragma once

#include <functional>
#include <string>

#include "tools/common/extent.h"

namespace prospect::tools {

// Work that is cut into numbered items and spread over processes, because neither HDF5 nor a
// world's set-up wants threads. Item i goes to process i modulo `jobs`, so a result never depends
// on timing.
//
// `work` runs in a child and returns one line of text (no newline inside); `on_result` runs in the
// caller's process, in the order in which results arrive. With jobs <= 1 everything runs in the
// caller.
//
// Ctrl-C or TERM (base/stop_signals.h, installed here) ends it early: children are killed, and what
// they had finished is delivered; with jobs <= 1 the item at hand is finished first. A second
// signal ends the program. Children die with the caller. Throws std::runtime_error when a child
// died before it had done its items, with the words of the exception that ended it if there was
// one; base::DiskError if it was one.
[[nodiscard]] Extent ForkMap(int items, int jobs,
                             const std::function<std::function<std::string(int)>()>& make_work,
                             const std::function<void(int, const std::string&)>& on_result);

}  // namespace prospect::tools
