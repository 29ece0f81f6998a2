#pragma once

#include <string>
#include <vector>

#include "model/training/train_config.h"

namespace prospect::model {

/// One row of the paper's comparison (Tables I and II) and of its text; `prospect train --help`
/// says what each is (cli/commands/train.cpp).
struct Variant {
  std::string name;      ///< as --variant takes it
  std::string in_table;  ///< as the paper's tables write it
};

/// In the order of the paper's tables; what only its text names comes last.
const std::vector<Variant>& Variants();

/// Changes what the variant changes: T's losses (C beside a picture loss of whatever weight),
/// links, skips. The rest, iterations of T's own updates included, stays. Throws
/// std::invalid_argument that lists the known names.
void ApplyVariant(const std::string& name, TrainConfig* config);

}  // namespace prospect::model
