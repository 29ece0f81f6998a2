#include "cli/help.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "cli/installation.h"

namespace prospect::cli {
namespace {

constexpr std::size_t kIndent = 2;

// `words` from column `column` on, the first line after what stands there already.
std::string Wrapped(const std::string& words, std::size_t column) {
  std::istringstream in(words);
  std::string text, word;
  std::size_t at = column;
  while (in >> word) {
    if (at > column && at + 1 + word.size() > kHelpColumns) {
      text += "\n" + std::string(column, ' ');
      at = column;
    } else if (at > column) {
      text += ' ';
      ++at;
    }
    text += word;
    at += word.size();
  }
  return text;
}

// Two columns: `left` and words; a long left side stands on a line of its own.
std::string Row(const std::string& left, const std::string& words, std::size_t column) {
  std::string line = std::string(kIndent, ' ') + left;
  if (line.size() + 2 > column) {
    line += "\n" + std::string(column, ' ');
  } else {
    line.resize(column, ' ');
  }
  return line + Wrapped(words, column) + "\n";
}

const char* Title(Group group) {
  switch (group) {
    case Group::kTry:
      return "Try it";
    case Group::kRun:
      return "Keep it running";
    case Group::kLook:
      return "Look at what happens";
    case Group::kTrain:
      return "Train";
    case Group::kMeasure:
      return "Measure";
  }
  return "";
}

// What the option's type name holds before (type) and after (what is allowed) the first colon.
std::pair<std::string, std::string> TypeOf(const CLI::Option& option) {
  const std::string whole = option.get_type_name();
  const std::size_t colon = whole.find(':');
  if (colon == std::string::npos) return {whole, ""};
  return {whole.substr(0, colon), whole.substr(colon + 1)};
}

std::string WordsOf(const CLI::Option& option) {
  const std::string allowed = TypeOf(option).second;
  const std::string usual = option.get_default_str();
  std::string notes = allowed;
  if (option.get_required()) notes += (notes.empty() ? "" : "; ") + std::string("required");
  if (!usual.empty()) notes += (notes.empty() ? "" : "; ") + ("default " + usual);
  const std::string& words = option.get_description();
  return notes.empty() ? words : words + " (" + notes + ")";
}

bool IsShown(const CLI::Option* option) { return !option->get_group().empty(); }

}  // namespace

std::string Spelling(const CLI::Option& option) {
  const std::string type = TypeOf(option).first;
  if (!option.nonpositional()) return option.get_name();
  std::string name;
  for (const std::string& letter : option.get_snames()) name += "-" + letter + ", ";
  name += "--" + option.get_lnames().front();
  return option.get_expected_max() == 0 || type.empty() ? name : name + " " + type;
}

std::string Overview(const std::vector<Command>& commands) {
  std::size_t column = 0;
  for (const Command& command : commands) column = std::max(column, command.name.size());
  column += kIndent + 2;
  std::string text =
      "Prospect: looks at a scene, imagines what its actions would do, and acts on the best\n"
      "imagined plan or refuses.\n\nusage: " +
      TypedName() + " COMMAND [OPTION...]\n";
  for (const Group group :
       {Group::kTry, Group::kRun, Group::kLook, Group::kTrain, Group::kMeasure}) {
    text += std::string("\n") + Title(group) + "\n";
    for (const Command& command : commands)
      if (command.group == group) text += Row(command.name, command.summary, column);
  }
  return text + "\n" + TypedName() + " COMMAND --help tells the options of one; " + TypedName() +
         " --dry-run COMMAND ...\nchecks what was typed and does nothing.\n\n"
         "Exit codes: 0 success, 2 usage, 3 refused, 4 failed or stopped, 5 figure out of "
         "tolerance,\n"
         "10 weights, 11 bus, 12 bus in use, 13 disk, 14 data file, 15 service lost, 16 time-out,\n"
         "130 interrupted.\n";
}

std::string HelpOf(const CLI::App& app) {
  const std::string before = "usage: ";
  std::string usage = app.get_name();
  for (const CLI::Option* option : app.get_options(IsShown)) {
    if (option->nonpositional()) {
      if (option->get_required()) usage += " " + Spelling(*option);
      continue;
    }
    const std::string more = option->get_items_expected_max() > 1 ? "..." : "";
    const std::string name = option->get_name() + more;
    usage += option->get_required() ? " " + name : " [" + name + "]";
  }
  std::string summary = app.get_description();
  if (!summary.empty()) summary[0] = static_cast<char>(std::toupper(summary[0]));
  std::string text = before + Wrapped(usage + " [OPTION...]", before.size()) + "\n\n" +
                     Wrapped(summary, 0) + ".\n";
  constexpr std::size_t kColumn = 26;
  for (const std::string& group : app.get_groups()) {
    if (group.empty()) continue;
    text += "\n" + group + ":\n";
    for (const CLI::Option* option : app.get_options())
      if (option->get_group() == group && option != app.get_help_ptr())
        text += Row(Spelling(*option), WordsOf(*option), kColumn);
    if (group == app.get_help_ptr()->get_group())
      text += Row(Spelling(*app.get_help_ptr()), WordsOf(*app.get_help_ptr()), kColumn);
  }
  return app.get_footer().empty() ? text : text + "\n" + app.get_footer() + "\n";
}

}  // namespace prospect::cli
