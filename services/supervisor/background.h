#pragma once

#include <optional>

#include "base/descriptor.h"

namespace prospect::services {

/// Goes on in a child that no terminal reaches, while this process waits until the child says that
/// it is ready, or ends. Call before there are threads, files or locks.
/// @param ready in the child: for SayReady()
/// @return nothing in the child; here, the exit status to end with: 0, or the child's
/// @throws std::runtime_error when there can be no child
std::optional<int> GoOnInBackground(base::Descriptor* ready);

/// Lets the waiting process end with 0; from now on nothing is printed where that one printed to.
void SayReady(base::Descriptor* ready);

}  // namespace prospect::services
