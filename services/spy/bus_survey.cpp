#include "services/spy/bus_survey.h"

#include <iomanip>
#include <ostream>

#include "lcmtypes/checked_codec.h"
#include "services/common/authenticity.h"

namespace prospect::services {
namespace {

bool IsDecodable(const messages::TypeSchema* type, const RawMessage& message, std::size_t size) {
  if (!type || messages::WalkMessage(*type, message.bytes.data(), size)) return false;
  const ChannelInfo* channel = FindChannel(message.channel);
  return !channel || std::string(channel->type_name) == type->name;
}

}  // namespace

void BusSurvey::Add(const RawMessage& message) {
  if (message.channel == "LCM_SELF_TEST") return;  // each program sends one as it starts
  const messages::TypeSchema* type = messages::FindByFingerprint(
      messages::FingerprintOf(message.bytes.data(), message.bytes.size()));
  const std::string name = type ? type->name : "?";
  SurveyRow& row = rows_[message.channel];
  row.channel = message.channel;
  row.type = row.messages == 0 || row.type == name ? name : "several";
  ++row.messages;
  row.bytes += static_cast<std::int64_t>(message.bytes.size());
  const std::size_t size = UntaggedSize(message.bytes.data(), message.bytes.size());
  row.undecodable += IsDecodable(type, message, size) ? 0 : 1;
  row.refused += message.refused ? 1 : 0;
  row.tagged += !message.refused && size < message.bytes.size() ? 1 : 0;
}

std::vector<SurveyRow> BusSurvey::rows() const {
  std::vector<SurveyRow> rows;
  for (const auto& [channel, row] : rows_) rows.push_back(row);
  return rows;
}

void BusSurvey::Print(double seconds, std::ostream& out) const {
  out << std::left << std::setw(20) << "channel" << std::setw(22) << "type" << std::right
      << std::setw(9) << "messages" << std::setw(10) << "rate Hz" << std::setw(12) << "bytes/s"
      << std::setw(13) << "undecodable" << std::setw(9) << "refused"
      << "\n"
      << std::fixed << std::setprecision(1);
  std::int64_t tagged = 0;
  for (const auto& [channel, row] : rows_) {
    out << std::left << std::setw(20) << channel << std::setw(22) << row.type << std::right
        << std::setw(9) << row.messages << std::setw(10)
        << static_cast<double>(row.messages) / seconds << std::setw(12)
        << static_cast<double>(row.bytes) / seconds << std::setw(13) << row.undecodable
        << std::setw(9) << row.refused << "\n";
    tagged += row.tagged;
  }
  if (tagged > 0)
    out << tagged << " messages carry a tag of a key that was not given here (--key)\n";
  if (rows_.empty()) out << "nothing was heard in " << seconds << " s\n";
}

nlohmann::json BusSurvey::ToJson(double seconds) const {
  nlohmann::json result = {{"seconds", seconds}, {"rows", nlohmann::json::array()}};
  std::int64_t messages = 0;
  std::int64_t undecodable = 0;
  std::int64_t refused = 0;
  std::int64_t tagged = 0;
  for (const auto& [channel, row] : rows_) {
    messages += row.messages;
    undecodable += row.undecodable;
    refused += row.refused;
    tagged += row.tagged;
    result["rows"].push_back({{"channel", channel},
                              {"type", row.type},
                              {"messages", row.messages},
                              {"rate_hz", static_cast<double>(row.messages) / seconds},
                              {"bytes_per_s", static_cast<double>(row.bytes) / seconds},
                              {"undecodable", row.undecodable},
                              {"refused", row.refused},
                              {"tagged", row.tagged}});
  }
  result["messages"] = messages;
  result["undecodable"] = undecodable;
  result["refused"] = refused;
  result["tagged"] = tagged;
  return result;
}

}  // namespace prospect::services
