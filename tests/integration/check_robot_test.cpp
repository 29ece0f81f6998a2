// The simulator keeps to the rules of whoever carries actions out, and who breaks them is told so.
// The example robots: example_robot_test.py.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

struct Checked {
  int code = -1;
  std::map<std::string, std::string> verdicts;  // by rule
};

Checked Check(Witness& witness, const std::string& folder) {
  Process check("prospect-bus", {"check-robot", "--json", folder + "/check.json"},
                folder + "/check.log");
  Checked result;
  witness.Until([&] { return (result.code = check.Wait(0)) >= 0; }, 90000);
  const auto file = nlohmann::json::parse(ReadText(folder + "/check.json"), nullptr, false);
  if (file.is_discarded()) return result;
  for (const auto& row : file.at("rows")) result.verdicts[row.at("rule")] = row.at("verdict");
  return result;
}

TEST(CheckRobot, TheSimulatorPasses) {
  Witness witness;
  Deployment deployment("check_simulator");
  deployment.Simulator({"--frames-per-second", "4"});  // so that actions last
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("simulator", 1); }, 20000));
  const Checked checked = Check(witness, deployment.folder);
  EXPECT_EQ(checked.code, 0) << ReadText(deployment.folder + "/check.log");
  EXPECT_EQ(checked.verdicts.at("CANCEL stops the robot within 1 s"), "ok");
  EXPECT_EQ(checked.verdicts.at("the robot stops within 5 s when its executive falls silent"),
            "ok");
}

TEST(CheckRobot, TheSimulatorPassesWhenItsEpisodeIsOver) {
  Witness witness;
  Deployment deployment("check_after_episode");
  deployment.Simulator();
  auto& executive = deployment.Executive({"--policy", "plan:0,1,3"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
  const Checked checked = Check(witness, deployment.folder);
  EXPECT_EQ(checked.code, 0) << ReadText(deployment.folder + "/check.log");
  EXPECT_EQ(checked.verdicts.at("a START that fits is taken within 3 s"), "ok");
}

TEST(CheckRobot, NobodyThereIsAFault) {
  Witness witness;
  const std::string folder = MakeFolder("check_nobody");
  const Checked checked = Check(witness, folder);
  EXPECT_EQ(checked.code, 4);
  EXPECT_EQ(checked.verdicts.at("TASK is published at least every 3 s"), "FAULT");
}

}  // namespace
}  // namespace prospect::tests
