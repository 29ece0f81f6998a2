#include "cli/values.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <system_error>

#include "planner/goal.h"

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

// Whether all of "0,2,1" are numbers of actions.
bool IsPlan(const std::string& numbers) {
  constexpr int kMostDigits = 3;
  int digits = 0;
  for (const char c : numbers + ',') {
    if (c >= '0' && c <= '9' && digits < kMostDigits) {
      ++digits;
    } else if (c == ',' && digits > 0) {
      digits = 0;
    } else {
      return false;
    }
  }
  return true;
}

// "align(green)", "move", "on(a,b)"; not what has a bracket too many or no name.
bool IsActionName(const std::string& text) {
  const std::size_t open = text.find('(');
  const bool bare = open == std::string::npos && text.find(')') == std::string::npos;
  const bool whole = open != std::string::npos && open > 0 && open + 2 < text.size() &&
                     text.find_first_of("()", open + 1) == text.size() - 1 && text.back() == ')';
  return !text.empty() && (bare || whole);
}

// Parts at commas outside brackets, without spaces around them.
std::vector<std::string> Items(const std::string& text) {
  std::vector<std::string> items(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth <= 0) {
      items.emplace_back();
    } else if (c != ' ') {
      items.back() += c;
    }
  }
  return items;
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

CLI::Validator Goal() {
  return Made(
      [](std::string& text) -> std::string {
        try {
          planner::ParseGoal(text);
          return "";
        } catch (const std::exception& error) {
          return error.what();
        }
      },
      "");
}

CLI::Validator Policy() {
  return Made(
      [](std::string& text) -> std::string {
        if (text == "search" || text == "collect" || text == "expert") return "";
        if (!text.starts_with("plan:"))
          return "unknown policy '" + text + "'; known: search, collect, expert, plan:A,B,...";
        return IsPlan(text.substr(5)) ? "" : "give action indices, as in plan:0,2,1";
      },
      "");
}

CLI::Validator PlanOfNames() {
  return Made(
      [](std::string& text) -> std::string {
        for (const std::string& item : Items(text)) {
          if (IsActionName(item)) continue;
          return "'" + text + "' is no plan: '" + item +
                 "' is no name of an action; say align(green),grasp(green)";
        }
        return "";
      },
      "");
}

CLI::Validator PartOfParts() {
  return Made(
      [](std::string& text) -> std::string {
        constexpr int kMost = 1000;
        int part = 0, parts = 0;
        const char* end = text.data() + text.size();
        const auto [slash, bad] = std::from_chars(text.data(), end, part);
        if (bad == std::errc() && slash != end && *slash == '/') {
          const auto [stopped, error] = std::from_chars(slash + 1, end, parts);
          if (error == std::errc() && stopped == end && part >= 1 && part <= parts &&
              parts <= kMost)
            return "";
        }
        return "wants a part and their number, such as 1/8 to 8/8, of at most 1000, not '" + text +
               "'";
      },
      "");
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
