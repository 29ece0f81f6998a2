#include "services/executive/bus_episode.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "base/random.h"
#include "services/executive/greedy_mind.h"
#include "services/executive/plan_message.h"
#include "services/executive/policy.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLabelMs = 3000;

// Of the scene; one that was not made from a seed is told from others by its episode's name.
std::uint64_t SeedFor(const BusView& view, const ExecutiveOptions& options) {
  const auto wanted = static_cast<std::uint64_t>(options.seed);
  if (view.label() && view.label()->seed >= 0)
    return static_cast<std::uint64_t>(view.label()->seed);
  if (options.reset) return wanted;
  return base::MixSeeds({wanted, static_cast<std::uint64_t>(view.episode_id())});
}

std::vector<int> PlanFor(Conversation& talk, const ExecutiveOptions& options) {
  if (options.policy != "collect" && options.policy != "expert") return ParsePlan(options.policy);
  const BusView& view = talk.view();
  talk.Until([&] { return view.label() || !view.LabelsExpected(); }, kLabelMs);
  return CollectPlan(*view.task(), view.label(), SeedFor(view, options),
                     options.policy == "collect");
}

ExecutiveOptions Whole(Conversation& talk, ExecutiveOptions options) {
  options.explain = options.explain_only || !options.out.empty();
  options.illustrate = true;
  if (!options.AsksNetworks()) {
    const ExecutiveOptions given = options;
    options.plan = [&talk, given] { return PlanFor(talk, given); };
  }
  return options;
}

std::unique_ptr<BusMind> MindFor(Conversation& talk, const ExecutiveOptions& options) {
  if (options.policy == "greedy") return std::make_unique<GreedyMind>(talk, options);
  return std::make_unique<BusMind>(talk, options);
}

}  // namespace

void BusEpisode::Speaker::Note(const std::string& line) { spdlog::info("{}", line); }
void BusEpisode::Speaker::Warn(const std::string& line) { spdlog::warn("{}", line); }

void BusEpisode::Speaker::Searched(const agent::SearchRecord& search, const planner::Plan& plan) {
  spdlog::info("search {}: {} rollouts, {} evaluations, {:.2f} s; {}", ++searches_, search.rollouts,
               search.evaluations, search.seconds, Summary(plan, *talk_.view().task()));
}

void BusEpisode::Speaker::PlanChanged(const agent::EpisodeRecord& record) {
  plan_t plan = PlanMessage(record);
  plan.executive_id = talk_.id();
  plan.episode_id = talk_.view().episode_id();
  talk_.Say(plan);
}

BusEpisode::BusEpisode(Conversation& talk, const ExecutiveOptions& options, Tell tell)
    : talk_(talk),
      options_(Whole(talk, options)),
      speaker_(talk, std::move(tell)),
      world_(talk, options_),
      mind_(MindFor(talk, options_)),
      episode_(world_, mind_.get(), options_, speaker_) {}

agent::EpisodeRecord BusEpisode::Run() { return Leave(episode_.Run()); }

agent::EpisodeRecord BusEpisode::Stopped(const std::string& reason) {
  return Leave(episode_.Stopped(reason));
}

agent::EpisodeRecord BusEpisode::Leave(agent::EpisodeRecord record) {
  talk_.health().SetState(health_t::STATE_DRAINING, record.outcome);
  talk_.health().PublishNow();
  return record;
}

}  // namespace prospect::services
