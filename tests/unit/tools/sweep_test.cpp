#include "tools/train/sweep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>

namespace prospect::tools {
namespace {

class Sweep : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  cli::TrainOptions Typed(std::vector<std::string> words) const {
    words.insert(words.begin(), {"--data=d.h5", "--out=runs", "--sweep=" + file_});
    std::reverse(words.begin(), words.end());
    CLI::App app;
    cli::TrainOptions options;
    Define(app, options);
    app.parse(words);
    return options;
  }
  cli::TrainOptions Run(int index, std::vector<std::string> words = {}) const {
    words.push_back("--index=" + std::to_string(index));
    return SweptRun(Typed(words));
  }
  void Write(const std::string& runs) const { std::ofstream(file_) << runs; }
  // The words with which a file is refused.
  std::string Refusal(const std::string& runs, std::vector<std::string> words = {}) const {
    Write(runs);
    try {
      Run(1, std::move(words));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "not refused";
  }

  std::string file_ = (std::filesystem::temp_directory_path() /
                       ("sweep_test_" + std::to_string(getpid()) + ".yaml"))
                          .string();
};

TEST_F(Sweep, ARunHasWhatWasTypedAndItsOwn) {
  Write("- {name: l1, variant: l1}\n- {finetune: true, without: [views, focus], seed: 2}\n");
  const cli::TrainOptions first = Run(1, {"--iterations=50", "--task=navigation"});
  EXPECT_EQ(first.task, "navigation");
  EXPECT_EQ(first.data, "d.h5");
  EXPECT_EQ(first.out, "runs/l1");
  EXPECT_EQ(first.variant, "l1");
  EXPECT_EQ(first.iterations, 50);
  EXPECT_TRUE(first.sweep.empty());
  const cli::TrainOptions second = Run(2);
  EXPECT_EQ(second.out, "runs/2");
  EXPECT_TRUE(second.finetune);
  EXPECT_EQ(second.without, (std::vector<std::string>{"views", "focus"}));
  EXPECT_EQ(second.seed, 2);
  EXPECT_EQ(second.iterations, 0);
  EXPECT_THROW(Run(3), std::invalid_argument);
}

TEST_F(Sweep, WhatARunCannotBeIsNamed) {
  EXPECT_NE(Refusal("- {seed: x}").find("run 1: "), std::string::npos);
  EXPECT_NE(Refusal("- {nonsense: 1}").find("nonsense"), std::string::npos);
  EXPECT_NE(Refusal("- {seed: 1}", {"--seed=2"}).find("--seed is typed, too"), std::string::npos);
  EXPECT_NE(Refusal("- {seed: 1, seed: 2}").find("twice"), std::string::npos);
  EXPECT_NE(Refusal("- {out: x}").find("--out is for none"), std::string::npos);
  EXPECT_NE(Refusal("- {name: ../x}").find("no name of a folder"), std::string::npos);
  EXPECT_NE(Refusal("seed: 1").find("is no list of runs"), std::string::npos);
  EXPECT_NE(Refusal("- seed").find("run 1: is no map"), std::string::npos);
  EXPECT_NE(Refusal("- {").find(file_), std::string::npos);
  std::filesystem::remove(file_);
  EXPECT_THROW(Run(1), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::tools
