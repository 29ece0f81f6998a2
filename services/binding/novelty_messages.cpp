#include "services/binding/novelty_messages.h"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace prospect::services {
namespace {

using model::Novelty;

struct Field {
  const char* name;
  double Novelty::*value;
};

constexpr Field kFields[] = {{"p", &Novelty::p},
                             {"error", &Novelty::error},
                             {"error_limit", &Novelty::error_limit},
                             {"residual", &Novelty::residual},
                             {"residual_limit", &Novelty::residual_limit},
                             {"state", &Novelty::state},
                             {"state_limit", &Novelty::state_limit}};

}  // namespace

std::string NoveltyText(const Novelty& novelty) {
  std::string text;
  for (const Field& field : kFields) {
    char item[64];
    std::snprintf(item, sizeof item, "%s%s=%.9g", text.empty() ? "" : " ", field.name,
                  novelty.*field.value);
    text += item;
  }
  return text;
}

std::optional<Novelty> NoveltyFrom(const std::string& text) {
  std::istringstream in(text);
  Novelty novelty;
  for (const Field& field : kFields) {
    std::string item;
    const std::string name = std::string(field.name) + "=";
    if (!(in >> item) || item.compare(0, name.size(), name) != 0) return std::nullopt;
    std::istringstream number(item.substr(name.size()));
    double& value = novelty.*field.value;
    if (!(number >> value) || !number.eof() || !std::isfinite(value) || value < 0)
      return std::nullopt;
  }
  std::string rest;
  if (in >> rest || novelty.p > 1) return std::nullopt;
  return novelty;
}

}  // namespace prospect::services
