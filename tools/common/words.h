#pragma once

#include <iostream>

#include "base/quiet.h"

namespace prospect::tools {

/// Where a command says what it found: standard output, or nowhere where it is to be quiet.
inline std::ostream& Words() {
  static std::ostream nowhere(nullptr);
  return base::Quiet() ? nowhere : std::cout;
}

}  // namespace prospect::tools
