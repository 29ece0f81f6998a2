#include "tools/verify/figures.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "base/yaml_keys.h"

namespace prospect::verify {
namespace {

std::vector<std::string> Words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::map<std::string, std::string> Values(const YAML::Node& node) {
  std::map<std::string, std::string> values;
  for (const auto& item : node)
    values[item.first.as<std::string>()] = item.second.as<std::string>();
  return values;
}

Figure FigureOf(const YAML::Node& node) {
  Figure figure;
  figure.name = node["name"].as<std::string>();
  figure.pointer = node["pointer"].as<std::string>();
  figure.printed = node["printed"].as<std::string>();
  if (node["at_most"]) {
    figure.at_most = node["at_most"].as<double>();
    return figure;
  }
  figure.quick = node["quick"].as<double>();
  figure.full = node["full"].as<double>();
  figure.tolerance = node["tolerance"].as<double>();
  return figure;
}

Measurement MeasurementOf(const YAML::Node& node) {
  Measurement measurement;
  measurement.name = node["name"].as<std::string>();
  for (const auto& command : node["commands"]) {
    measurement.commands.push_back(Words(command.as<std::string>()));
  }
  measurement.quick = Values(node["quick"]);
  measurement.full = Values(node["full"]);
  for (const auto& figure : node["figures"]) measurement.figures.push_back(FigureOf(figure));
  return measurement;
}

}  // namespace

std::vector<Measurement> ReadMeasurements(const std::string& path) {
  std::vector<Measurement> measurements;
  try {
    const YAML::Node file = YAML::LoadFile(path);
    const std::string twice = base::KeyTwice(file);
    if (!twice.empty()) throw std::invalid_argument(path + ": names '" + twice + "' twice");
    for (const auto& node : file) measurements.push_back(MeasurementOf(node));
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
  if (measurements.empty()) throw std::invalid_argument(path + ": lists no measurements");
  return measurements;
}

std::vector<std::string> Fill(const std::vector<std::string>& command,
                              const std::map<std::string, std::string>& values) {
  std::vector<std::string> filled;
  for (std::string word : command) {
    for (std::size_t open = word.find('{'); open != std::string::npos;
         open = word.find('{', open)) {
      const std::size_t close = word.find('}', open);
      const std::string name = word.substr(open + 1, close - open - 1);
      const auto value = values.find(name);
      if (close == std::string::npos || value == values.end()) {
        throw std::invalid_argument("no value for '" + word.substr(open) + "' in a command");
      }
      word.replace(open, close - open + 1, value->second);
      open += value->second.size();
    }
    filled.push_back(word);
  }
  return filled;
}

Verdict Judge(const Figure& figure, bool full, const nlohmann::json& report) {
  const nlohmann::json::json_pointer pointer(figure.pointer);
  if (!report.contains(pointer) || !report.at(pointer).is_number()) {
    throw std::invalid_argument("the report has no number at " + figure.pointer);
  }
  Verdict verdict;
  verdict.measured = report.at(pointer).get<double>();
  if (figure.at_most) {
    verdict.expected = *figure.at_most;
    verdict.within = verdict.measured <= verdict.expected;
    return verdict;
  }
  verdict.expected = full ? figure.full : figure.quick;
  verdict.within = std::abs(verdict.measured - verdict.expected) <= figure.tolerance + 1e-9;
  return verdict;
}

}  // namespace prospect::verify
