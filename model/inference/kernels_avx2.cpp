#define PROSPECT_LANES 8
#define PROSPECT_TILE_ROWS 4
#include "model/inference/kernels_body.h"

namespace prospect::model::inference {
extern const Kernels kAvx2Kernels;
constinit const Kernels kAvx2Kernels = MakeKernels("avx2");
}  // namespace prospect::model::inference
