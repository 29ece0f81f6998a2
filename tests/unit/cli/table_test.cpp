#include "cli/table.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "cli/completion.h"
#include "cli/help.h"

namespace prospect::cli {
namespace {

// Calls `look` with every command that has its options in the table.
template <typename Look>
void ForEach(const Look& look) {
  for (const Command& command : Commands()) {
    if (!command.define) continue;
    SCOPED_TRACE(command.name);
    CLI::App app;
    SetUp(app, command.name);
    const Bound bound = command.define(app);
    look(command, app);
  }
}

std::size_t LongestLine(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

int Times(const std::string& text, const std::string& line_begin) {
  std::istringstream lines(text);
  int times = 0;
  for (std::string line; std::getline(lines, line);) times += line.starts_with(line_begin) ? 1 : 0;
  return times;
}

TEST(Table, NamesEachCommandOnce) {
  std::set<std::string> names;
  for (const Command& command : Commands()) {
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
    EXPECT_FALSE(command.summary.empty()) << command.name;
    EXPECT_FALSE(command.summary.ends_with('.')) << command.name;
  }
}

TEST(Table, HelpNamesEveryCommandAndFits) {
  const std::string help = Overview(Commands());
  EXPECT_LE(LongestLine(help), kHelpColumns);
  for (const Command& command : Commands())
    EXPECT_EQ(Times(help, "  " + command.name + "  "), 1) << command.name;
}

TEST(Table, HelpOfEachCommandNamesEachOptionOnceAndFits) {
  ForEach([](const Command&, const CLI::App& app) {
    const std::string help = HelpOf(app);
    EXPECT_LE(LongestLine(help), kHelpColumns) << help;
    for (const CLI::Option* option : app.get_options()) {
      if (option->get_group().empty()) continue;
      EXPECT_FALSE(option->get_description().empty()) << Spelling(*option);
      EXPECT_EQ(Times(help, "  " + Spelling(*option)), 1) << Spelling(*option) << "\n" << help;
    }
  });
}

TEST(Table, TheTaskHasOneDefault) {
  ForEach([](const Command& command, const CLI::App& app) {
    const CLI::Option* task = app.get_option_no_throw("--task");
    if (task == nullptr) return;
    const std::string usual = task->get_default_str();
    EXPECT_TRUE(usual.empty() || usual.find("stacking") == 0 ||
                (usual == "all" && task->get_items_expected_max() > 1))
        << command.name << ": " << usual;
  });
}

TEST(Table, CompletionListsEveryCommandAndOption) {
  const std::string script = BashCompletion(Commands());
  ForEach([&](const Command& command, const CLI::App& app) {
    const std::size_t at = script.find("'" + command.name + "') words='");
    ASSERT_NE(at, std::string::npos);
    const std::string words = script.substr(at, script.find('\n', at) - at) + " ";
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames())
        EXPECT_TRUE(words.find("--" + name + " ") != std::string::npos ||
                    words.find("--" + name + "'") != std::string::npos)
            << name;
  });
}

}  // namespace
}  // namespace prospect::cli
