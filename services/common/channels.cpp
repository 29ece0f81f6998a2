#include "services/common/channels.h"

namespace prospect::services {
namespace {

// Capacities: pictures and statistics arrive in bursts of many small messages while an engine
// computes a batch; orders and states are few.
constexpr int kBurst = 4096;
constexpr int kPictures = 256;
constexpr int kFew = 128;

template <class T>
ChannelInfo Row(int queue_capacity) {
  return {ChannelOf<T>(), T::getTypeName(), queue_capacity};
}

}  // namespace

const std::vector<ChannelInfo>& Channels() {
  static const std::vector<ChannelInfo> kChannels = {Row<action_command_t>(kFew),
                                                     Row<action_status_t>(kFew),
                                                     Row<calibration_t>(kFew),
                                                     Row<expand_reply_t>(kBurst),
                                                     Row<expand_request_t>(kBurst),
                                                     Row<health_t>(kFew),
                                                     Row<label_t>(kPictures),
                                                     Row<model_info_t>(kFew),
                                                     Row<observation_t>(kPictures),
                                                     Row<plan_t>(kFew),
                                                     Row<predict_reply_t>(kPictures),
                                                     Row<predict_request_t>(kPictures),
                                                     Row<search_image_t>(kPictures),
                                                     Row<search_root_t>(kFew),
                                                     Row<search_statistics_t>(kBurst),
                                                     Row<search_stop_t>(kFew),
                                                     Row<sim_command_t>(kFew),
                                                     Row<task_t>(kFew),
                                                     Row<verdict_t>(kFew)};
  return kChannels;
}

const ChannelInfo* FindChannel(const std::string& name) {
  for (const ChannelInfo& channel : Channels()) {
    if (name == channel.name) return &channel;
  }
  return nullptr;
}

}  // namespace prospect::services
