#include "tools/train/sweep.h"

#include <yaml-cpp/yaml.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/text.h"
#include "base/yaml_keys.h"

namespace prospect::tools {
namespace {

using Words = std::vector<std::string>;

[[noreturn]] void Refuse(const cli::TrainOptions& options, const std::string& why) {
  throw std::invalid_argument(options.sweep + ": " + why);
}

[[noreturn]] void RefuseRun(const cli::TrainOptions& options, const std::string& why) {
  Refuse(options, "run " + std::to_string(options.index) + ": " + why);
}

// Throws YAML::Exception.
YAML::Node ReadRuns(const cli::TrainOptions& options) {
  YAML::Node runs = YAML::LoadFile(options.sweep);
  if (!runs.IsSequence()) Refuse(options, "is no list of runs");
  if (const std::string twice = base::KeyTwice(runs); !twice.empty())
    Refuse(options, "'" + twice + "' stands there twice");
  if (static_cast<std::size_t>(options.index) > runs.size()) {
    Refuse(options,
           "has " + std::to_string(runs.size()) + " runs, no run " + std::to_string(options.index));
  }
  return runs;
}

bool IsTyped(const Words& typed, const std::string& name) {
  return std::any_of(typed.begin(), typed.end(), [&](const std::string& word) {
    return word == name || word.starts_with(name + "=");
  });
}

// An option of the file as it is typed; empty: a flag that is false.
std::string WordOf(const std::string& name, const YAML::Node& value) {
  if (value.IsSequence()) return name + "=" + base::Joined(value.as<Words>(), ",");
  const auto text = value.as<std::string>();
  if (text == "true") return name;
  return text == "false" ? "" : name + "=" + text;
}

// What is asked for, the run's folder apart.
Words WordsOf(const cli::TrainOptions& options, const YAML::Node& run) {
  Words words = options.asked;
  for (const auto& entry : run) {
    const auto key = entry.first.as<std::string>();
    if (key == "name") continue;
    const std::string name = "--" + key;
    if (key == "out" || key == "sweep" || key == "index") RefuseRun(options, name + " is for none");
    if (IsTyped(options.asked, name)) RefuseRun(options, name + " is typed, too");
    if (const std::string word = WordOf(name, entry.second); !word.empty()) words.push_back(word);
  }
  return words;
}

std::string NameOf(const cli::TrainOptions& options, const YAML::Node& run) {
  const std::string name =
      run["name"] ? run["name"].as<std::string>() : std::to_string(options.index);
  const bool folder = !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
  if (!folder) RefuseRun(options, "'" + name + "' is no name of a folder");
  return name;
}

cli::TrainOptions Parsed(const cli::TrainOptions& options, Words words) {
  CLI::App app;
  cli::TrainOptions run;
  Define(app, run);
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    RefuseRun(options, error.what());
  }
  if (const std::string defect = Defect(run); !defect.empty()) RefuseRun(options, defect);
  return run;
}

}  // namespace

cli::TrainOptions SweptRun(const cli::TrainOptions& options) {
  try {
    const YAML::Node runs = ReadRuns(options);
    const YAML::Node run = runs[static_cast<std::size_t>(options.index - 1)];
    if (!run.IsMap()) RefuseRun(options, "is no map of options");
    Words words = WordsOf(options, run);
    if (!options.out.empty()) words.push_back("--out=" + options.out + "/" + NameOf(options, run));
    cli::TrainOptions swept = Parsed(options, std::move(words));
    swept.report = options.report;
    return swept;
  } catch (const YAML::Exception& error) {
    Refuse(options, error.what());
  }
}

}  // namespace prospect::tools
