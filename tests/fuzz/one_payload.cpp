#include "tests/fuzz/one_payload.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/validate.h"
#include "planner/path_tree.h"
#include "planner/search_parameters.h"
#include "planner/shared_statistics.h"
#include "services/binding/evaluation_messages.h"
#include "services/binding/search_messages.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::fuzz {
namespace {

constexpr std::size_t kSealBytes = 8;

// What receivers do with sound messages. Rules and parameters out of range are refused by
// exception, as their headers say; nothing else may be thrown.
template <class T>
void Use(const T&) {}

void Use(const task_t& task) {
  services::TaskHash(task);
  try {
    services::RulesFromTask(task);
  } catch (const std::invalid_argument&) {
  }
}

void Use(const search_root_t& root) {
  services::SearchIdFrom(root);
  services::ExecutedFrom(root);
  try {
    services::ParametersFrom(root, 0);
  } catch (const std::invalid_argument&) {
  }
}

void Use(const expand_request_t& request) { services::FromMessages(request.paths); }

void Use(const expand_reply_t& reply) {
  constexpr int kActions = 7;
  for (const auto& evaluation : reply.evaluations) services::FromMessage(evaluation, kActions);
}

void Use(const search_statistics_t& statistics) {
  planner::PathTree paths(planner::kMaxActions);
  planner::SharedStatisticsOptions options;
  options.search = {static_cast<std::uint64_t>(statistics.search_id),
                    static_cast<std::uint32_t>(statistics.epoch)};
  options.writer = 1;
  planner::SharedStatistics table(&paths, options);
  planner::StatisticsBatch batch = services::FromMessage(statistics);
  table.Merge(batch, 0);
  // Once more as if the sender had meant it: rows of any content reach the table.
  batch.checksum = planner::PayloadChecksum(batch);
  table.Merge(batch, 0);
  table.MakeBatch(4096, 0);
}

template <class T>
bool Decode(const std::vector<std::uint8_t>& bytes) {
  const auto result = messages::CheckedDecode<T>(bytes.data(), bytes.size());
  if (!result.ok()) return false;
  const auto again = messages::CheckedEncode(result.value);
  const bool sealed = std::strcmp(messages::SchemaOf<T>().fields.back().name, "seal") == 0;
  const std::size_t covered = bytes.size() - (sealed ? kSealBytes : 0);
  if (again.size() != bytes.size() ||
      !std::equal(bytes.begin(), bytes.begin() + static_cast<long>(covered), again.begin())) {
    throw std::logic_error(std::string(T::getTypeName()) + " encodes to other bytes");
  }
  if (messages::Validate(result.value).empty()) Use(result.value);
  return true;
}

template <class T>
bool Feed(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  bool accepted = Decode<T>(bytes);
  if (size >= kSealBytes) {
    std::fill(bytes.end() - kSealBytes, bytes.end(), std::uint8_t{0});
    accepted = Decode<T>(bytes) || accepted;
  }
  return accepted;
}

template <class T>
Target TargetOf() {
  return {T::getTypeName(), Feed<T>};
}

}  // namespace

const std::vector<Target>& Targets() {
  static const std::vector<Target> kTargets = {
      TargetOf<action_command_t>(), TargetOf<action_status_t>(),  TargetOf<calibration_t>(),
      TargetOf<expand_reply_t>(),   TargetOf<expand_request_t>(), TargetOf<health_t>(),
      TargetOf<label_t>(),          TargetOf<model_info_t>(),     TargetOf<observation_t>(),
      TargetOf<plan_t>(),           TargetOf<predict_reply_t>(),  TargetOf<predict_request_t>(),
      TargetOf<search_image_t>(),   TargetOf<search_root_t>(),    TargetOf<search_statistics_t>(),
      TargetOf<search_stop_t>(),    TargetOf<sim_command_t>(),    TargetOf<task_t>(),
      TargetOf<verdict_t>()};
  return kTargets;
}

const Target* FindTarget(const std::string& type) {
  for (const Target& target : Targets()) {
    if (type == target.type) return &target;
  }
  return nullptr;
}

}  // namespace prospect::fuzz
