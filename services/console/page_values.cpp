#include "services/console/page_values.h"

#include <stdexcept>
#include <string>

namespace prospect::services::console {

using nlohmann::json;

planner::Path PathFrom(const json& value) {
  if (!value.is_array() || value.size() > planner::kMaxPathLength)
    throw std::invalid_argument("not a path");
  planner::Path path;
  for (const json& action : value) {
    if (!action.is_number_unsigned() || action.get<std::uint64_t>() >= planner::kMaxActions)
      throw std::invalid_argument("not an action");
    path.push_back(static_cast<std::uint8_t>(action.get<unsigned>()));
  }
  return path;
}

std::int64_t IdFrom(const json& value) {
  const std::string text = value.get<std::string>();
  if (text.empty() || text.size() > 19 || text.find_first_not_of("0123456789") != std::string::npos)
    throw std::invalid_argument("not an id");
  return std::stoll(text);
}

}  // namespace prospect::services::console
