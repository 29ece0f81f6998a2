// What ships and what is measured are one loop: the executive, over the bus with a real model
// server and a worker, and the evaluation, in this process, do the same in the same scenes.

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "agent/episode.h"
#include "model/novelty.h"
#include "report/episode_report.h"
#include "sim/task_factory.h"
#include "tests/integration/support/deployment.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/search_deciders.h"
#include "tools/evaluate/simulated_world.h"

namespace prospect::tests {
namespace {

using nlohmann::json;

constexpr int kScenes = 20;        // of each task
constexpr int kFirst = 1'400'000;  // tuning scenes: never in a reported figure
constexpr int kSamples = 20;
constexpr int kAttempts = 5;

std::string Weights(const std::string& task) {
  return std::string(PROSPECT_ROOT) + "/model/weights/" + task + ".safetensors";
}

// In this process.
class Here {
 public:
  explicit Here(const std::string& task)
      : task_(sim::MakeTask(task, world_)), engine_(model::LoadSearchEngine(Weights(task), 1)) {
    planner::SearchParameters search;
    search.samples = kSamples;
    search.depth = 0;
    search.UseRule(engine_->info().calibrations.at(0).rule);
    const agent::EpisodeOptions usual;
    decider_ = tools::MakeLearned(tools::PlanBy::kSearch, engine_.get(), search, {}, usual.retries,
                                  usual.surprise);
    decider_->options.refusal_threshold = -1;  // the weights' own
    if (const auto gauge = model::NoveltyGauge::Load(Weights(task)))
      decider_ = tools::MakeNoveltyGate(std::move(decider_), engine_.get(), *gauge, usual.novelty);
  }

  json Run(std::uint64_t seed) {
    tools::SimulatedWorld world(*task_, seed, world_.image_noise);
    decider_->mind->Enter(*task_, seed);
    agent::Listener nobody;
    agent::Episode episode(world, decider_->mind.get(), decider_->options, nobody);
    return json::parse(report::ResultJson(episode.Run(), 0));
  }

 private:
  sim::TaskOptions world_;
  std::unique_ptr<sim::Task> task_;
  std::unique_ptr<model::Engine> engine_;
  std::unique_ptr<tools::Decider> decider_;
};

// The executive and its services, started once.
class OverTheBus {
 public:
  explicit OverTheBus(const std::string& task)
      : scene_(task == "stacking" ? std::vector<std::string>{"--tower", "2"}
                                  : std::vector<std::string>{"--objects", "4", "--legs", "3"}),
        deployment_("hosts_agree_" + task) {
    deployment_.Simulator({"--task", task, "--frames-per-second", "3000"});
    deployment_.ModelServer({"--weights", Weights(task)});
    deployment_.Worker();
  }

  bool Ready() {
    return witness_.Until(
        [&] {
          return witness_.Ready("simulator", 1) && witness_.Ready("model", 1) &&
                 witness_.Ready("worker", 1);
        },
        20000);
  }

  // On a busy machine a server may answer too late, whereupon nothing is done: again then.
  json Run(int seed) {
    json result;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      result = RunOnce(seed);
      const std::string reason = result.at("reason");
      if (reason.find("no server ") == std::string::npos) break;
    }
    return result;
  }

 private:
  // One evaluation in flight: with more, what a worker asks for next depends on when answers come.
  json RunOnce(int seed) {
    std::vector<std::string> asked{"--samples", std::to_string(kSamples), "--leaves", "1"};
    asked.insert(asked.end(), scene_.begin(), scene_.end());
    Process& executive = deployment_.Executive(asked, seed);
    int code = -1;
    EXPECT_TRUE(witness_.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
    deployment_.Forget(executive);
    return deployment_.Result();
  }

  std::vector<std::string> scene_;  // options that ask for it
  Witness witness_;
  Deployment deployment_;
};

// V and f travel in steps of 1/65535, so that last digits may differ.
constexpr double kWireRounding = 1e-4;

std::string WithoutNumbers(const json& text) {
  return std::regex_replace(text.get<std::string>(), std::regex("[0-9.]+"), "#");
}

void ExpectSame(const json& there, const json& here, int seed) {
  for (const char* key :
       {"task", "world_version", "seed", "objects", "plan_length", "outcome", "actions"})
    EXPECT_EQ(there.at(key), here.at(key)) << seed << " " << key;
  EXPECT_EQ(WithoutNumbers(there.at("reason")), WithoutNumbers(here.at("reason"))) << seed;
  ASSERT_EQ(there.at("searches").size(), here.at("searches").size()) << seed;
  for (std::size_t i = 0; i < here.at("searches").size(); ++i) {
    const json& a = there.at("searches")[i];
    const json& b = here.at("searches")[i];
    for (const char* key : {"decision", "plan"})
      EXPECT_EQ(a.value(key, json()), b.value(key, json())) << seed << ", search " << i;
    EXPECT_EQ(a.contains("note"), b.contains("note")) << seed << ", search " << i;
    for (const char* key : {"score", "threshold", "root_value"})
      EXPECT_NEAR(a.at(key), b.at(key), kWireRounding) << seed << ", search " << i << " " << key;
  }
}

void Compare(const std::string& task) {
  OverTheBus bus(task);
  ASSERT_TRUE(bus.Ready());
  Here here(task);
  std::map<std::string, int> outcomes;
  for (int seed = kFirst; seed < kFirst + kScenes; ++seed) {
    const json there = bus.Run(seed);
    ExpectSame(there, here.Run(static_cast<std::uint64_t>(seed)), seed);
    ++outcomes[there.at("outcome")];
  }
  EXPECT_GT(outcomes["solved"], 0) << "so that whole episodes were compared";
  EXPECT_LT(outcomes["solved"], kScenes) << "and others";
}

TEST(HostsAgree, InStacking) { Compare("stacking"); }
TEST(HostsAgree, InNavigation) { Compare("navigation"); }

}  // namespace
}  // namespace prospect::tests
