#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <utility>
#include <vector>

#include "model/engine.h"

namespace prospect::services {

/// Encodes pictures and remembers the latest few by content: the episode's first picture comes with
/// each of its searches. One thread; the engine must outlive it.
class PictureEncoder {
 public:
  explicit PictureEncoder(model::Engine& engine, std::size_t capacity = 16)
      : engine_(engine), capacity_(capacity) {}

  /// @param rgb height x width x 3 bytes, of the engine's size
  const model::Hidden& Encode(const std::vector<std::uint8_t>& rgb);

 private:
  model::Engine& engine_;
  std::size_t capacity_;
  std::list<std::pair<std::vector<std::uint8_t>, model::Hidden>> latest_;  // most recent first
};

}  // namespace prospect::services
