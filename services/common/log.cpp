#include "services/common/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

namespace prospect::services {
namespace {

// spdlog takes an unknown word for "off", which would hide a typing error together with everything
// else.
spdlog::level::level_enum ParseLevel(const std::string& level) {
  const auto parsed = spdlog::level::from_str(level);
  if (parsed == spdlog::level::off && level != "off") {
    throw std::runtime_error("log level '" + level +
                             "' is unknown: use trace, debug, info, warn, error or off");
  }
  return parsed;
}

}  // namespace

void SetUpLog(const std::string& component, const std::string& level) {
  const auto parsed = ParseLevel(level);
  auto logger = std::make_shared<spdlog::logger>(
      component, std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern(kLogPattern);
  logger->set_level(parsed);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace prospect::services
