#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace prospect::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// The real messages of a type, recorded from a bus: the files of tests/fuzz/corpus/TYPE, by name.
/// @throws std::runtime_error that says how to record them when there are none
std::vector<Bytes> Corpus(const std::string& type);

}  // namespace prospect::fuzz
