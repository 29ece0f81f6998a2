#include "services/common/chaos_rules.h"

#include <stdexcept>

#include "services/common/ids.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLongestDelayMs = 60000;

[[noreturn]] void Fail(const std::string& what) {
  throw std::invalid_argument(
      what +
      "; say for example drop=0.3,delay=20ms,dup=0.05,reorder=0.1,corrupt=0.01,seed=1,"
      "channel=SEARCH_.*");
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

double Share(const std::string& key, const std::string& value) {
  std::size_t used = 0;
  double share = -1;
  try {
    share = std::stod(value, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != value.size() || !(share >= 0 && share <= 1)) {
    Fail(key + " wants a share from 0 to 1, not '" + value + "'");
  }
  return share;
}

std::uint64_t Whole(const std::string& key, const std::string& value, std::uint64_t most) {
  std::size_t used = 0;
  std::uint64_t number = 0;
  try {
    number = std::stoull(value, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != value.size() || value[0] == '-' || number > most) {
    Fail(key + " wants a whole number up to " + std::to_string(most) + ", not '" + value + "'");
  }
  return number;
}

std::int64_t Milliseconds(const std::string& value) {
  const bool unit = value.size() > 2 && value.ends_with("ms");
  return static_cast<std::int64_t>(
      Whole("delay", unit ? value.substr(0, value.size() - 2) : value, kLongestDelayMs));
}

void SetChannel(const std::string& value, ChaosRule* rule) {
  try {
    rule->channel = std::regex(value);
  } catch (const std::regex_error&) {
    Fail("channel=" + value + " is no regular expression");
  }
}

void SetKey(const std::string& key, const std::string& value, ChaosRule* rule) {
  if (key == "drop") return void(rule->drop = Share(key, value));
  if (key == "dup") return void(rule->dup = Share(key, value));
  if (key == "reorder") return void(rule->reorder = Share(key, value));
  if (key == "corrupt") return void(rule->corrupt = Share(key, value));
  if (key == "delay") return void(rule->delay_ms = Milliseconds(value));
  if (key == "seed") return void(rule->seed = Whole(key, value, UINT64_MAX));
  if (key == "channel") return SetChannel(value, rule);
  Fail("'" + key + "' is no kind of chaos");
}

ChaosRule ParseRule(const std::string& text) {
  ChaosRule rule;
  rule.channel = ".*";
  rule.text = text;
  for (const std::string& part : Split(text, ',')) {
    const auto equals = part.find('=');
    if (equals == std::string::npos) Fail("'" + part + "' has no '='");
    SetKey(part.substr(0, equals), part.substr(equals + 1), &rule);
  }
  if (rule.seed == 0) {
    rule.seed = static_cast<std::uint64_t>(RandomId());
    rule.text += ",seed=" + std::to_string(rule.seed);
  }
  return rule;
}

}  // namespace

std::vector<ChaosRule> ParseChaos(const std::string& text) {
  std::vector<ChaosRule> rules;
  if (text.empty()) return rules;
  for (const std::string& part : Split(text, ';')) rules.push_back(ParseRule(part));
  return rules;
}

std::string ChaosDefect(const std::string& text) {
  try {
    ParseChaos(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace prospect::services
