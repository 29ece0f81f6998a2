#pragma once

#include <cstddef>

namespace prospect::fuzz {

/// Bytes asked of malloc, calloc and realloc since the program began, by any code in it, whether
/// given back or not.
std::size_t BytesAsked();

}  // namespace prospect::fuzz
