#include "services/model/picture_encoder.h"

#include <algorithm>

namespace prospect::services {

const model::Hidden& PictureEncoder::Encode(const std::vector<std::uint8_t>& rgb) {
  const auto known = std::find_if(latest_.begin(), latest_.end(),
                                  [&](const auto& entry) { return entry.first == rgb; });
  if (known != latest_.end()) {
    latest_.splice(latest_.begin(), latest_, known);
  } else {
    latest_.emplace_front(rgb, engine_.Encode(rgb));
    if (latest_.size() > capacity_) latest_.pop_back();
  }
  return latest_.front().second;
}

}  // namespace prospect::services
