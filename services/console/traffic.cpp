#include "services/console/traffic.h"

#include <cmath>

namespace prospect::services::console {
namespace {

constexpr std::int64_t kWindowUs = 1'000'000;
constexpr std::size_t kMostReasons = 16;
constexpr char kOthers[] = "(others)";

}  // namespace

void Traffic::Add(const std::string& channel, std::size_t bytes, const std::string& refused,
                  std::int64_t now_us) {
  const bool room = rows_.contains(channel) || rows_.size() < kMostChannels;
  Row& row = rows_[room ? channel : kOthers];
  ++row.messages;
  row.bytes += static_cast<std::int64_t>(bytes);
  if (!refused.empty()) {
    const bool known = row.refused.contains(refused) || row.refused.size() < kMostReasons;
    ++row.refused[known ? refused : kOthers];
  }
  if (since_us_ == 0) since_us_ = now_us;
}

void Traffic::TakeRates(std::int64_t now_us) {
  const std::int64_t passed_us = now_us - since_us_;
  if (passed_us >= 0 && passed_us < kWindowUs) return;
  for (auto& [name, row] : rows_) {
    const double seconds = passed_us > 0 ? 1e-6 * static_cast<double>(passed_us) : 1;
    row.per_second =
        std::round(10 * static_cast<double>(row.messages - row.messages_then) / seconds) / 10;
    row.bytes_per_second = std::round(static_cast<double>(row.bytes - row.bytes_then) / seconds);
    row.messages_then = row.messages;
    row.bytes_then = row.bytes;
  }
  since_us_ = now_us;
}

nlohmann::json Traffic::ToJson(std::int64_t now_us) {
  TakeRates(now_us);
  nlohmann::json rows = nlohmann::json::array();
  for (const auto& [name, row] : rows_) {
    rows.push_back({{"name", name},
                    {"messages", row.messages},
                    {"bytes", row.bytes},
                    {"per_second", row.per_second},
                    {"bytes_per_second", row.bytes_per_second},
                    {"refused", row.refused}});
  }
  return rows;
}

}  // namespace prospect::services::console
