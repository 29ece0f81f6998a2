#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace prospect::base {

/// The known word that a mistyped one most likely meant: the one with the fewest letters changed,
/// left out, added or swapped with a neighbour, where a word that begins as typed costs nothing
/// more than a letter. @return empty when none is near
std::string NearestWord(std::string_view typed, const std::vector<std::string>& known);

}  // namespace prospect::base
