#pragma once

#include <cstdio>
#include <string>

namespace prospect::report {

/// As printf would, for one number.
inline std::string Number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace prospect::report
