#pragma once

#include <string>
#include <vector>

#include "lcmtypes/messages.h"

namespace prospect::services {

/// The bus in one table: each channel carries one message type. What a subscriber's queue holds
/// between two polls is set here too, on purpose: LCM keeps 30 by default and then drops the
/// newest.
struct ChannelInfo {
  const char* name;       ///< as on the bus
  const char* type_name;  ///< as in lcmtypes, such as "observation_t"
  int queue_capacity;     ///< messages that wait inside LCM between polls
};

/// All channels, by name in alphabetical order.
const std::vector<ChannelInfo>& Channels();

/// The row of a channel, or null for a channel that is not ours.
const ChannelInfo* FindChannel(const std::string& name);

/// The channel that carries T: `ChannelOf<observation_t>()` is "OBSERVATION". Only types that
/// travel alone have one.
template <class T>
constexpr const char* ChannelOf();

// clang-format off
template <> constexpr const char* ChannelOf<action_command_t>() { return "ACTION_COMMAND"; }
template <> constexpr const char* ChannelOf<action_status_t>() { return "ACTION_STATUS"; }
template <> constexpr const char* ChannelOf<calibration_t>() { return "CALIBRATION"; }
template <> constexpr const char* ChannelOf<expand_reply_t>() { return "EXPAND_REPLY"; }
template <> constexpr const char* ChannelOf<expand_request_t>() { return "EXPAND_REQUEST"; }
template <> constexpr const char* ChannelOf<health_t>() { return "HEALTH"; }
template <> constexpr const char* ChannelOf<label_t>() { return "LABEL"; }
template <> constexpr const char* ChannelOf<model_info_t>() { return "MODEL_INFO"; }
template <> constexpr const char* ChannelOf<observation_t>() { return "OBSERVATION"; }
template <> constexpr const char* ChannelOf<plan_t>() { return "PLAN"; }
template <> constexpr const char* ChannelOf<predict_reply_t>() { return "PREDICT_REPLY"; }
template <> constexpr const char* ChannelOf<predict_request_t>() { return "PREDICT_REQUEST"; }
template <> constexpr const char* ChannelOf<search_image_t>() { return "SEARCH_IMAGE"; }
template <> constexpr const char* ChannelOf<search_root_t>() { return "SEARCH_ROOT"; }
template <> constexpr const char* ChannelOf<search_statistics_t>() { return "SEARCH_STATISTICS"; }
template <> constexpr const char* ChannelOf<search_stop_t>() { return "SEARCH_STOP"; }
template <> constexpr const char* ChannelOf<sim_command_t>() { return "SIM_COMMAND"; }
template <> constexpr const char* ChannelOf<task_t>() { return "TASK"; }
template <> constexpr const char* ChannelOf<verdict_t>() { return "VERDICT"; }
// clang-format on

}  // namespace prospect::services
