#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/tables/scorer.h"

namespace prospect::tools {

/// The rows stored in `path`, if they were made from `key` (everything that they depend on); else
/// made, and stored there. A damaged file is made anew. Throws what `make` throws, and
/// std::runtime_error if the file cannot be written.
std::vector<Row> CachedRows(const std::string& path, const std::string& key,
                            const std::function<std::vector<Row>()>& make);

}  // namespace prospect::tools
