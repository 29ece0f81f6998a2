#include "cli/command.h"

#include <algorithm>
#include <cstdio>

#include "base/exit_codes.h"
#include "base/nearest.h"
#include "cli/help.h"
#include "cli/installation.h"
#include "cli/table.h"

namespace prospect::cli {
namespace {

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// Another command of the same group that has the option; empty: none has.
std::string NeighbourWith(const std::string& option, const std::string& command) {
  const Command* here = FindCommand(command);
  if (here == nullptr) return "";
  for (const Command& other : Commands()) {
    if (other.group != here->group || &other == here || !other.define) continue;
    CLI::App app;
    const Bound bound = other.define(app);
    if (app.get_option_no_throw(option) != nullptr) return other.name;
  }
  return "";
}

// "train" of an app of ours.
std::string CommandOf(const CLI::App& app) {
  const std::string& name = app.get_name();
  return name.substr(name.find(' ') + 1);
}

// What was typed that no option takes; empty: nothing.
std::string Stray(const CLI::App& app) {
  const std::vector<std::string> rest = app.remaining();
  if (rest.empty()) return "";
  const std::string word = rest.front().substr(0, rest.front().find('='));
  if (!word.starts_with("-")) return "'" + word + "' is too much";
  const std::string unknown = "unknown option '" + word + "'";
  const std::string other = NeighbourWith(word, CommandOf(app));
  if (!other.empty()) return unknown + "; " + TypedName() + " " + other + " has it";
  const std::string nearest = base::NearestWord(word, OptionNames(app));
  return nearest.empty() ? unknown : unknown + "; did you mean " + nearest + "?";
}

std::string InOurWords(const std::string& said) {
  // "--tower: wants ...", where a check of cli/values.h speaks
  if (const auto at = said.find(": wants "); at != std::string::npos)
    return said.substr(0, at) + said.substr(at + 1);
  if (const auto at = said.find(": unknown task "); at != std::string::npos)
    return said.substr(at + 2);
  // "--seed: 1 required INT missing"
  if (said.find(" required ") != std::string::npos && said.ends_with(" missing"))
    return said.substr(0, said.find(':')) + " needs a value";
  return said;
}

int Tell(const CLI::App& app, const std::string& what) {
  std::fprintf(stderr, "prospect: %s (%s --help)\n", what.c_str(), app.get_name().c_str());
  return kExitUsage;
}

}  // namespace

void SetUp(CLI::App& app, std::string_view command) {
  const Command* entry = FindCommand(command);
  app.name((entry != nullptr ? TypedName() + " " : "") + std::string(command));
  if (entry != nullptr) app.description(entry->summary);
  app.set_help_flag("-h,--help", "these lines");
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.allow_extras();
}

std::vector<std::string> Given(const CLI::App& app,
                               const std::function<bool(const std::string&)>& wanted) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (!wanted(name)) continue;
    if (option->get_expected_max() == 0) {
      words.push_back(name);
    } else {
      for (const std::string& value : option->reduced_results())
        words.push_back(name + "=" + value);
    }
  }
  return words;
}

std::optional<int> ParseArguments(CLI::App& app, std::vector<std::string> arguments,
                                  const std::function<std::string()>& defect) {
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    std::fputs(HelpOf(app).c_str(), stdout);
    return kExitSuccess;
  } catch (const CLI::ParseError& error) {
    const std::string stray = Stray(app);  // rather than what is missing because of it
    return Tell(app, stray.empty() ? InOurWords(error.what()) : stray);
  }
  if (const std::string stray = Stray(app); !stray.empty()) return Tell(app, stray);
  if (const std::string wrong = defect(); !wrong.empty()) return Tell(app, wrong);
  return std::nullopt;
}

}  // namespace prospect::cli
