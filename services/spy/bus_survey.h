#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "services/common/bus.h"

namespace prospect::services {

/// What was heard on one channel.
struct SurveyRow {
  std::string channel;
  std::string
      type;  ///< by fingerprint; "?" for a type that is not ours, "several" for more than one
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  std::int64_t undecodable =
      0;  ///< unknown type, bytes that are no whole message, or the wrong type for our channel
  std::int64_t refused = 0;  ///< without the deployment's key, or played again
  std::int64_t tagged = 0;   ///< carry a tag that nobody here could check, for want of the key
};

/// Counts traffic by channel: the spy without a window. Knows types by their fingerprint and
/// decides by the same walk that the services use whether a message could be decoded. Not
/// thread-safe.
class BusSurvey {
 public:
  void Add(const RawMessage& message);

  /// By channel, in alphabetical order.
  std::vector<SurveyRow> rows() const;

  /// A table for people. @param seconds time listened, above 0
  void Print(double seconds, std::ostream& out) const;

  /// Keys: seconds, messages, undecodable, refused, tagged, rows: [{channel, type, messages,
  /// rate_hz, bytes_per_s, undecodable, refused, tagged}].
  nlohmann::json ToJson(double seconds) const;

 private:
  std::map<std::string, SurveyRow> rows_;
};

}  // namespace prospect::services
