#include "cli/values.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace prospect::cli {
namespace {

// 0.1 as 0.1, 256 as 256.
std::string Short(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

bool ParseReal(const std::string& text, double* value) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && stopped == end;
}

CLI::Validator Made(std::function<std::string(std::string&)> check, const std::string& allowed) {
  return CLI::Validator(std::move(check), allowed);
}

}  // namespace

CLI::Validator Whole(std::int64_t least, std::int64_t most) {
  const std::string allowed = std::to_string(least) + " to " + std::to_string(most);
  constexpr std::int64_t kWorthTelling = 1'000'000'000;
  return Made(
      [=](std::string& text) -> std::string {
        std::int64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [stopped, error] = std::from_chars(text.data(), end, value, 10);
        if (error != std::errc() || stopped != end || value < least || value > most)
          return "wants a whole number from " + allowed + ", not '" + text + "'";
        text = std::to_string(value);  // without leading zeros, which would make it octal
        return "";
      },
      most < kWorthTelling ? allowed
      : least == 0         ? ""
                           : std::to_string(least) + " and up");
}

CLI::Validator Real(double least, double most) {
  const std::string allowed = Short(least) + " to " + Short(most);
  return Made(
      [=](std::string& text) -> std::string {
        double value = 0;
        if (ParseReal(text, &value) && value >= least && value <= most) return "";
        return "wants a number from " + allowed + ", not '" + text + "'";
      },
      allowed);
}

CLI::Validator Share() {
  return Made(
      [](std::string& text) -> std::string {
        double value = 0;
        if (ParseReal(text, &value) && value > 0 && value < 1) return "";
        return "wants a share between 0 and 1, such as 0.05, not '" + text + "'";
      },
      "between 0 and 1");
}

CLI::Validator OneOf(const std::vector<std::string>& words) {
  std::string allowed;
  for (const std::string& word : words) allowed += (allowed.empty() ? "" : ", ") + word;
  return Made(
      [=](std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return "";
        return "wants one of " + allowed + ", not '" + text + "'";
      },
      allowed);
}

}  // namespace prospect::cli
