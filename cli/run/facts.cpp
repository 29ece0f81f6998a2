#include "cli/run/facts.h"

#include "cli/report_file.h"

namespace prospect::cli {

void Tell(const ReportOptions& report, const ReportFacts& facts) {
  nlohmann::json object = nlohmann::json::object();
  for (const auto& [name, value] : facts)
    std::visit([&, key = name](const auto& held) { object[key] = held; }, value);
  WriteReport(report, object);
}

std::string Count(int number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

}  // namespace prospect::cli
