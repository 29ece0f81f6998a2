#pragma once

#include <string>
#include <vector>

#include "cli/fwd.h"

namespace prospect::cli {

/// How pictures differ from those of trials (sim/shift.h). Both or none is given.
struct ShiftOptions {
  std::string factor;  ///< one of ShiftFactors(); empty: none
  int strength = 0;    ///< 1 to 5
};

/// Adds --factor and --strength.
void DefineShift(CLI::App& app, ShiftOptions& shift);

std::vector<std::string> ShiftFactors();

}  // namespace prospect::cli
