#include "services/common/ids.h"

#include <sys/random.h>

#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace prospect::services {
namespace {

std::optional<std::int64_t>& Override() {
  static std::optional<std::int64_t> id;
  return id;
}

std::int64_t ParseDeployment(const std::string& text) {
  try {
    std::size_t used = 0;
    const long long value = std::stoll(text, &used);
    if (used == text.size() && value >= 1) return value;
  } catch (const std::exception&) {
  }
  throw std::runtime_error(
      "PROSPECT_DEPLOYMENT is '" + text +
      "': set it to a decimal number from 1 to 9223372036854775807, or unset it");
}

}  // namespace

std::int64_t RandomId() {
  std::uint64_t bits = 0;
  do {
    if (getrandom(&bits, sizeof bits, 0) != static_cast<ssize_t>(sizeof bits)) {
      throw std::runtime_error("the system gives no random numbers (getrandom failed)");
    }
    bits &= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  } while (bits == 0);
  return static_cast<std::int64_t>(bits);
}

std::int64_t DeploymentId() {
  if (Override()) return *Override();
  const char* text = std::getenv("PROSPECT_DEPLOYMENT");
  return text && *text ? ParseDeployment(text) : 0;
}

void SetDeploymentId(std::int64_t id) { Override() = id; }

}  // namespace prospect::services
