#pragma once

#include <string>

#include "agent/explanation.h"

namespace prospect::report {

/// explain.html: verdict, what the camera sees, the chosen plan as a row of imagined pictures with
/// V and f under each, what a person asked for, the best alternatives with the sentence that says
/// what each lost by, and how the search went. One file that refers to nothing outside itself:
/// pictures are PNGs in data: URIs. Without pictures (a server that sent none) it has words only.
std::string ExplanationPage(const agent::Explanation& explanation);

}  // namespace prospect::report
