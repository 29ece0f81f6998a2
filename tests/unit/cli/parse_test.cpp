#include <gtest/gtest.h>

#include "cli/command.h"
#include "cli/commands/deployment.h"
#include "cli/commands/oracle.h"
#include "cli/program.h"

namespace prospect::cli {
namespace {

// What is told of a command line, and the status that it ends with.
template <typename Options>
std::pair<int, std::string> Told(const char* command, std::vector<std::string> words,
                                 Options* options) {
  CLI::App app;
  SetUp(app, command);
  Define(app, *options);
  testing::internal::CaptureStderr();
  const auto end = ParseArguments(app, std::move(words), [&] { return Defect(*options); });
  return {end.value_or(0), testing::internal::GetCapturedStderr()};
}

std::pair<int, std::string> ToldOfOracle(std::vector<std::string> words) {
  OracleOptions options;
  return Told("oracle", std::move(words), &options);
}

TEST(Parsing, AMistypedOptionIsAnsweredWithTheNearest) {
  const auto [status, said] = ToldOfOracle({"--sceens", "3"});
  EXPECT_EQ(status, 2);
  EXPECT_EQ(said,
            "prospect: unknown option '--sceens'; did you mean --scenes? "
            "(./prospect oracle --help)\n");
}

TEST(Parsing, RatherThanWithWhatIsMissingBecauseOfIt) {
  const auto [status, said] = ToldOfOracle({"--scense=x"});
  EXPECT_EQ(status, 2);
  EXPECT_NE(said.find("--scenes"), std::string::npos) << said;
}

TEST(Parsing, AValueIsNamedWithWhatIsAllowed) {
  EXPECT_NE(ToldOfOracle({"--tower", "5"})
                .second.find("--tower wants a whole number from 2 to 4, not '5'"),
            std::string::npos);
  EXPECT_NE(ToldOfOracle({"--scenes"}).second.find("--scenes needs a value"), std::string::npos);
}

TEST(Parsing, AMistypedTaskIsToldFromOneThatIsNotForTheCommand) {
  EXPECT_NE(ToldOfOracle({"--task", "juggling"})
                .second.find("unknown task 'juggling'; known: navigation, stacking"),
            std::string::npos);
  EXPECT_NE(ToldOfOracle({"--task", "knot_tying"}).second.find("not for this command"),
            std::string::npos);
}

TEST(Parsing, OptionsThatDoNotGoTogether) {
  EXPECT_EQ(ToldOfOracle({"--task", "stacking", "--legs", "4"}).first, 2);
  EXPECT_EQ(ToldOfOracle({"--task", "navigation", "--legs", "4"}).first, 0);
  RunOptions run;
  EXPECT_NE(Told("run", {"--no-reset", "--objects", "5"}, &run).second.find("--no-reset takes"),
            std::string::npos);
}

TEST(Parsing, AnOptionOfANeighbouringCommandIsSaidToBeIts) {
  RunOptions run;
  EXPECT_NE(Told("run", {"--factor", "light"}, &run).second.find("./prospect up has it"),
            std::string::npos);
}

TEST(Parsing, FillsTheOptions) {
  RunOptions run;
  EXPECT_EQ(Told("run", {"--seed", "007", "--goal", "on(red,blue)", "--no-reset"}, &run).first, 0);
  EXPECT_EQ(run.episode.seed, 7);
  EXPECT_EQ(run.episode.goal, "on(red,blue)");
  EXPECT_FALSE(run.reset);
}

TEST(Programs, ThatCarrySeveralCommandsOutAreToldWhich) {
  int ran = 0;
  const std::vector<Part> parts = {
      Carries<OracleOptions>("oracle", "oracle", [&ran](const OracleOptions& options) {
        ran = options.scenes;
        return 5;
      })};
  const char* right[] = {"/bin/prospect-world", "oracle", "--scenes", "7"};
  EXPECT_EQ(RunPart(4, right, parts), 5);
  EXPECT_EQ(ran, 7);
  testing::internal::CaptureStderr();
  const char* wrong[] = {"/bin/prospect-world", "oracel"};
  EXPECT_EQ(RunPart(2, wrong, parts), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "prospect-world: give one of oracle, not 'oracel'\n");
}

}  // namespace
}  // namespace prospect::cli
