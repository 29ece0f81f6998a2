#pragma once

/// All generated message types (namespace prospect: observation_t, ...). Their members are not
/// initialised: write `observation_t m{};`.
#include "lcmtypes/all_types.h"  // made at build time
