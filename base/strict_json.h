#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"

namespace prospect::base {

/// An object names a key twice.
struct KeyTwiceError : std::invalid_argument {
  explicit KeyTwiceError(std::vector<std::string> keys)
      : std::invalid_argument("names '" + Joined(keys, ".") +
                              "' twice, and which one counts is chance"),
        path(std::move(keys)),
        key(Joined(path, ".")) {}
  std::vector<std::string> path;  ///< the keys of the objects around it, and its own
  std::string key;                ///< the same as one text: "heads.batch"
};

/// Parses what people and other programs wrote: as nlohmann::json::parse without exceptions
/// (`discarded` where it is no JSON), but throws KeyTwiceError where an object names a key twice,
/// of which the parser alone would keep one in silence.
template <typename Input>
nlohmann::json ParseStrictJson(Input&& input) {
  struct Level {
    std::set<std::string> keys;
    std::string now;  // the key whose value is being read
  };
  using Event = nlohmann::json::parse_event_t;
  std::vector<Level> levels;
  const auto look = [&levels](int, Event event, nlohmann::json& parsed) {
    if (event == Event::object_start) levels.emplace_back();
    if (event == Event::object_end) levels.pop_back();
    if (event != Event::key) return true;
    levels.back().now = parsed.get<std::string>();
    if (levels.back().keys.insert(levels.back().now).second) return true;
    std::vector<std::string> path;
    for (const Level& level : levels) path.push_back(level.now);
    throw KeyTwiceError(path);
  };
  return nlohmann::json::parse(std::forward<Input>(input), look, /*allow_exceptions=*/false);
}

}  // namespace prospect::base
