#pragma once

#include "model/network_config.h"

namespace prospect::model {

/// Networks that are made and run in moments: pictures of 32 x 32, three actions.
inline NetworkConfig SmallConfig() {
  NetworkConfig config;
  config.image_width = config.image_height = 32;
  config.num_actions = 3;
  return config;
}

}  // namespace prospect::model
