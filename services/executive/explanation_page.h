#pragma once

#include <string>

#include "agent/explanation.h"

namespace prospect::services {

/// explain.html: verdict, what the camera sees, the chosen plan as a row of imagined pictures with
/// V and f under each, what a person asked for, the best alternatives with the sentence that says
/// what each lost by, and how the search went. One file that refers to nothing outside itself:
/// pictures are PNGs in data: URIs. Without pictures (a build without OpenCV, a server that sent
/// none) it has words only.
std::string ExplanationPage(const agent::Explanation& explanation);

/// The text with the five characters that mean something in HTML replaced, and control characters
/// by spaces.
std::string Escaped(const std::string& text);

/// RFC 4648, with padding.
std::string Base64(const std::string& bytes);

}  // namespace prospect::services
