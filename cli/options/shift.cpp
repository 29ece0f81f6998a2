#include "cli/options/shift.h"

#include "cli/values.h"

namespace prospect::cli {

std::vector<std::string> ShiftFactors() { return {"light", "camera", "colour", "noise"}; }

void DefineShift(CLI::App& app, ShiftOptions& shift) {
  CLI::Option* factor =
      app.add_option("--factor", shift.factor,
                     "shift what the camera shows away from what trials show; see --strength")
          ->type_name("NAME")
          ->check(OneOf(ShiftFactors()));
  CLI::Option* strength = app.add_option("--strength", shift.strength, "how far")
                              ->type_name("N")
                              ->transform(Whole(1, 5));
  factor->needs(strength);
  strength->needs(factor);
}

}  // namespace prospect::cli
