#pragma once

#include <string>

#include "lcmtypes/messages.h"

/// Whether a decoded message makes sense by itself: counts and sizes agree, numbers are finite and
/// within the range that the .lcm file states, enumerations hold known values, pictures have as
/// many bytes as pixels need. What depends on other messages (is this action in the table?) is the
/// receiver's to check. Pure functions, thread-safe.
namespace prospect::messages {

/// Limits that hold for every message. They are generous: they bound memory and keep nonsense out,
/// and are no tuning.
inline constexpr int kMaxActions = 255;  ///< rows of a task's table; an action travels as one byte
inline constexpr int kMaxPathLength = 64;    ///< actions in a path
inline constexpr int kMaxImageSide = 4096;   ///< pixels
inline constexpr int kMaxCalibrations = 64;  ///< kinds of scenes that weights were calibrated on
inline constexpr int kMaxPathsPerRequest = 256;

/// @return empty when the message is sound, else "value FIELD: what is wrong", short enough for a
/// counter's name
std::string Validate(const action_command_t& message);
std::string Validate(const action_status_t& message);
std::string Validate(const calibration_t& message);
std::string Validate(const expand_reply_t& message);
std::string Validate(const expand_request_t& message);
std::string Validate(const health_t& message);
std::string Validate(const label_t& message);
std::string Validate(const model_info_t& message);
std::string Validate(const observation_t& message);
std::string Validate(const plan_t& message);
std::string Validate(const predict_reply_t& message);
std::string Validate(const predict_request_t& message);
std::string Validate(const search_image_t& message);
std::string Validate(const search_root_t& message);
std::string Validate(const search_statistics_t& message);
std::string Validate(const search_stop_t& message);
std::string Validate(const sim_command_t& message);
std::string Validate(const task_t& message);
std::string Validate(const verdict_t& message);

}  // namespace prospect::messages
