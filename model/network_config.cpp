#include "model/network_config.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "model/json_fields.h"

namespace prospect::model {
namespace {

void Require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("network.") + what);
}

bool IsShare(double value) { return value >= 0.0 && value < 1.0; }

}  // namespace

void Validate(const NetworkConfig& c) {
  Require(c.image_width >= 32 && c.image_width <= 1024 && c.image_width % 16 == 0,
          "image_width: must be a multiple of 16 from 32 to 1024");
  Require(c.image_height >= 32 && c.image_height <= 1024 && c.image_height % 16 == 0,
          "image_height: must be a multiple of 16 from 32 to 1024");
  Require(c.hidden_channels >= 1 && c.hidden_channels <= 256, "hidden_channels: must be 1 to 256");
  Require(c.num_actions >= 1 && c.num_actions <= 255, "num_actions: must be 1 to 255");
  Require(c.transform_dropout >= -1 && c.transform_dropout < 1,
          "transform_dropout: must be at least 0, below 1, or -1: as dropout");
  Require(IsShare(c.dropout) && IsShare(c.head_dropout), "dropout: must be at least 0, below 1");
  Require(c.activation == "relu" || c.activation == "leaky_relu",
          "activation: must be relu or leaky_relu");
  Require(c.heads == "paper" || c.heads == "costar", "heads: must be paper or costar");
  Require(c.bottleneck == "soft_argmax" || c.bottleneck == "strided",
          "bottleneck: must be soft_argmax or strided");
  Require(c.transform_action == "bottleneck" || c.transform_action == "scale_and_shift",
          "transform_action: must be bottleneck or scale_and_shift");
  Require(c.transform_extra_stages >= 0 && c.transform_extra_stages <= 3,
          "transform_extra_stages: must be 0 to 3");
  const int divisor = 2 << c.transform_extra_stages;
  Require(c.hidden_width() % divisor == 0 && c.hidden_height() % divisor == 0,
          "transform_extra_stages: the hidden grid cannot be halved that often");
}

void to_json(nlohmann::json& json, const NetworkConfig& c) {
  json = {{"image_width", c.image_width},
          {"image_height", c.image_height},
          {"hidden_channels", c.hidden_channels},
          {"num_actions", c.num_actions},
          {"dropout", c.dropout},
          {"transform_dropout", c.transform_dropout},
          {"head_dropout", c.head_dropout},
          {"activation", c.activation},
          {"heads", c.heads},
          {"skip", c.skip},
          {"bottleneck", c.bottleneck},
          {"transform_action", c.transform_action},
          {"transform_mask", c.transform_mask},
          {"transform_extra_stages", c.transform_extra_stages}};
}

void from_json(const nlohmann::json& json, NetworkConfig& c) {
  JsonFields(json, "network")
      .Read("image_width", &c.image_width)
      .Read("image_height", &c.image_height)
      .Read("hidden_channels", &c.hidden_channels)
      .Read("num_actions", &c.num_actions)
      .Read("dropout", &c.dropout)
      .Read("transform_dropout", &c.transform_dropout)
      .Read("head_dropout", &c.head_dropout)
      .Read("activation", &c.activation)
      .Read("heads", &c.heads)
      .Read("skip", &c.skip)
      .Read("bottleneck", &c.bottleneck)
      .Read("transform_action", &c.transform_action)
      .Read("transform_mask", &c.transform_mask)
      .Read("transform_extra_stages", &c.transform_extra_stages)
      .RefuseOthers();
  Validate(c);
}

}  // namespace prospect::model
