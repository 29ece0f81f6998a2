#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tools/verify/figures.h"
#include "tools/verify/tables.h"

namespace prospect::verify {
namespace {

using nlohmann::json;

Figure Around(double quick, double full, double tolerance) {
  Figure figure;
  figure.pointer = "/f/share";
  figure.quick = quick;
  figure.full = full;
  figure.tolerance = tolerance;
  return figure;
}

json Report(double share) { return {{"f", {{"share", share}}}}; }

TEST(Figures, AreWithinOrOutsideTheirTolerance) {
  const Figure figure = Around(0.5, 0.8, 0.1);
  EXPECT_TRUE(Judge(figure, false, Report(0.6)).within);
  EXPECT_TRUE(Judge(figure, false, Report(0.4)).within);
  EXPECT_FALSE(Judge(figure, false, Report(0.61)).within);
  EXPECT_FALSE(Judge(figure, false, Report(0.39)).within);
  EXPECT_FALSE(Judge(figure, true, Report(0.6)).within) << "the published figure is another";
  EXPECT_TRUE(Judge(figure, true, Report(0.9)).within);
}

TEST(Figures, TimesHaveABound) {
  Figure figure = Around(0, 0, 0);
  figure.at_most = 0.4;
  EXPECT_TRUE(Judge(figure, false, Report(0.01)).within);
  EXPECT_FALSE(Judge(figure, false, Report(0.41)).within);
}

TEST(Figures, WhatWasNotMeasuredIsAFault) {
  const Figure figure = Around(0.5, 0.8, 0.1);
  EXPECT_THROW(Judge(figure, false, json::object()), std::invalid_argument);
  EXPECT_THROW(Judge(figure, false, {{"f", {{"share", nullptr}}}}), std::invalid_argument);
}

TEST(Commands, TakeValuesForTheirPlaceholders) {
  const std::vector<std::string> filled =
      Fill({"a", "--x={x}{y}", "{y}"}, {{"x", "1"}, {"y", "{z}"}});
  EXPECT_EQ(filled, (std::vector<std::string>{"a", "--x=1{z}", "{z}"}));
  EXPECT_THROW(Fill({"{other}"}, {{"x", "1"}}), std::invalid_argument);
  EXPECT_THROW(Fill({"{x"}, {{"x", "1"}}), std::invalid_argument);
}

TEST(FiguresFile, AKeyThatComesTwiceIsRefused) {
  const std::string path = testing::TempDir() + "figures_twice_" + std::to_string(getpid());
  std::ofstream(path) << "- name: a\n  commands: []\n  name: b\n";
  std::string why;
  try {
    ReadMeasurements(path);
  } catch (const std::invalid_argument& error) {
    why = error.what();
  }
  EXPECT_NE(why.find("names '[0].name' twice"), std::string::npos) << why;
}

// What is published and what is measured cannot part.
TEST(FiguresFile, EveryFigureStandsInTheResults) {
  std::ifstream in(std::string(PROSPECT_ROOT) + "/docs/results.md");
  std::stringstream text;
  text << in.rdbuf();
  std::string results = text.str();
  for (char& c : results) c = c == '\n' ? ' ' : c;  // a sentence may be broken anywhere
  for (const Measurement& m :
       ReadMeasurements(std::string(PROSPECT_ROOT) + "/config/figures.yaml")) {
    for (const Figure& figure : m.figures) {
      EXPECT_NE(results.find(figure.printed), std::string::npos)
          << m.name << ", " << figure.name << ": '" << figure.printed << "'";
    }
  }
}

TEST(Tables, ThoseWithoutAMeasuredFigureAreNamed) {
  const std::string markdown =
      "# All\n\n## One\n\n| a | b |\n|---|---|\n| x | 1.5 |\n\ntext | 2.5 |\n\n"
      "| | c |\n|---|---|\n| y | 2.5 |\n\n### Two\n| d | e |\n|---|---|\n| z | 3.5 |\n";
  Measurement measurement;
  measurement.figures.push_back(Around(0, 0, 0));
  measurement.figures.back().printed = "| y | 2.5 |";
  const std::vector<std::string> expected = {"One: a", "Two: d"};
  EXPECT_EQ(TablesNotMeasured(markdown, {measurement}), expected);
  EXPECT_EQ(TablesNotMeasured(markdown, {}).size(), 3U);
  EXPECT_TRUE(TablesNotMeasured("no table\n", {}).empty());
}

}  // namespace
}  // namespace prospect::verify
