#pragma once

#include <string>
#include <string_view>

namespace prospect::base {

/// The texts of a range, one behind the other: "a, b, c"; empty where there are none.
template <typename Texts>
std::string Joined(const Texts& texts, std::string_view between = ", ") {
  std::string all;
  bool first = true;
  for (const auto& text : texts) {
    if (!first) all += between;
    first = false;
    all += text;
  }
  return all;
}

}  // namespace prospect::base
