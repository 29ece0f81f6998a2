#define PROSPECT_LANES 16
#define PROSPECT_TILE_ROWS 8
#include "model/inference/kernels_body.h"

namespace prospect::model::inference {
extern const Kernels kAvx512Kernels;
constinit const Kernels kAvx512Kernels = MakeKernels("avx512");
}  // namespace prospect::model::inference
