#pragma once

#include <string>

#include "agent/explanation.h"

namespace prospect::report {

/// Each plan of the explanation as a strip of imagined pictures with V and f under each and the
/// sentence it lost by: chosen.png, alternative-1.png and so on, what-if.png. Those of an earlier
/// explanation that this one has no plan for are removed. Throws base::DiskError when a file
/// cannot be written.
void WriteExplanationPictures(const agent::Explanation& explanation, const std::string& folder);

}  // namespace prospect::report
