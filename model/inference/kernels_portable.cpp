#define PROSPECT_LANES 4
#define PROSPECT_TILE_ROWS 4
#include "model/inference/kernels_body.h"

namespace prospect::model::inference {
extern const Kernels kPortableKernels;
constinit const Kernels kPortableKernels = MakeKernels("portable");
}  // namespace prospect::model::inference
