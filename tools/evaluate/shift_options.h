#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "model/novelty.h"
#include "sim/shift.h"
#include "sim/task_factory.h"

namespace prospect::tools {

// What a closed loop may be asked about pictures unlike the known ones.
struct ShiftOptions {
  std::string factor;  // empty: no shift
  int strength = 0;
  bool open_loop = false;
  double novelty = model::kNoveltyLevel;
};

inline void AddShiftOptions(CLI::App* app, ShiftOptions* o) {
  CLI::Option* factor =
      app->add_option("--factor", o->factor, "Shift what the camera shows; see --strength")
          ->check(CLI::IsMember(sim::ShiftFactors()));
  CLI::Option* strength =
      app->add_option("--strength", o->strength, "How far, 1 to 5; all of both: --shifts")
          ->check(CLI::Range(1, sim::kShiftStrengths));
  factor->needs(strength);
  strength->needs(factor);
  app->add_flag("--open-loop", o->open_loop,
                "Carry the plan found from the first picture out as it is, without looking again");
  app->add_option("--novelty", o->novelty,
                  "First pictures with a smaller p-value are refused as unlike the known ones; "
                  "0: none")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

inline void ApplyShift(const ShiftOptions& options, sim::TaskOptions* world) {
  if (options.strength > 0) sim::SetShift(options.factor, options.strength, world);
}

}  // namespace prospect::tools
