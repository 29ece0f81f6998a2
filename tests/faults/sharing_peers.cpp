#include "tests/faults/sharing_peers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/binding/statistics_messages.h"
#include "services/common/clock.h"

namespace prospect::tests {
namespace {

constexpr int kActions = 4;
constexpr int kDepth = 4;
constexpr int kPeers = 4;
constexpr std::size_t kInFlight = 3;
constexpr std::size_t kBytes = 2000;
constexpr int kTickMs = 5;
constexpr int kLeaseMs = 1000;
constexpr planner::SearchId kSearch{77, 1};

std::int64_t NowUs() { return services::SteadyMs() * 1000; }

planner::SharedStatisticsOptions Options(std::uint64_t writer) {
  planner::SharedStatisticsOptions options;
  options.search = kSearch;
  options.writer = writer;
  options.lease_us = kLeaseMs * 1000;
  return options;
}

}  // namespace

void Truth::Note(std::uint64_t writer, const planner::StatisticsRow& row) {
  rows_[{writer, row.path, row.visits}] = {row.value_sum, row.best};
}

bool Truth::Knows(const planner::StatisticsRow& row) const {
  const auto found = rows_.find({row.writer, row.path, row.visits});
  return found != rows_.end() && found->second == std::make_pair(row.value_sum, row.best);
}

Peer::Peer(std::uint64_t writer, const std::string& chaos, Truth* truth)
    : truth_(truth), random_(writer), paths_(kActions), statistics_(&paths_, Options(writer)) {
  SetChaos(chaos);
}

void Peer::SetChaos(const std::string& chaos) {
  bus_ = std::make_unique<services::Bus>("", chaos);
  subscription_ = bus_->Subscribe<search_statistics_t>([this](const search_statistics_t& message) {
    statistics_.Merge(services::FromMessage(message), NowUs());
  });
}

Peer::Branch Peer::RandomBranch() {
  Branch branch{planner::kRoot};
  const int depth = 1 + static_cast<int>(random_() % kDepth);
  for (int i = 0; i < depth; ++i)
    branch.push_back(paths_.Add(branch.back(), static_cast<int>(random_() % kActions)));
  return branch;
}

void Peer::MakeRollout() {
  in_flight_.push_back(RandomBranch());
  for (const auto id : in_flight_.back()) statistics_.Begin(id);
  if (in_flight_.size() <= kInFlight) return;
  Complete(in_flight_.front());
  in_flight_.erase(in_flight_.begin());
}

void Peer::Complete(const Branch& branch) {
  const double value = static_cast<double>(random_() % 1000) / 999;
  for (const auto id : branch) statistics_.Complete(id, value);
  // A writer alone changes its rows, so after each rollout the sums over its own rows are all there
  // is to know; rows of others are left out by their writer's id.
  for (const auto& row : statistics_.AllRows()) {
    if (row.writer == statistics_.writer()) truth_->Note(row.writer, row);
  }
}

void Peer::Finish() {
  for (const auto& branch : in_flight_) Complete(branch);
  in_flight_.clear();
  statistics_.SetFinished(true);
}

void Peer::SayRows() {
  bus_->Publish(services::ToMessage(statistics_.MakeBatch(kBytes, NowUs()), kLeaseMs));
}

Peers::Peers(const std::string& chaos) {
  for (int i = 1; i <= kPeers; ++i) {
    const std::string own = chaos.empty() ? "" : chaos + ",seed=" + std::to_string(i);
    peers.push_back(std::make_unique<Peer>(static_cast<std::uint64_t>(i), own, &truth_));
  }
}

void Peers::SetChaos(const std::string& chaos) {
  for (auto& peer : peers) peer->SetChaos(chaos);
}

void Peers::Exchange() {
  const std::int64_t end_ms = services::SteadyMs() + kTickMs;
  for (auto& peer : peers) peer->SayRows();
  do {
    for (auto& peer : peers) peer->Hear(1);
  } while (services::SteadyMs() < end_ms);
}

void Peers::Work(int ticks, int rollouts) {
  for (int tick = 0; tick < ticks; ++tick) {
    for (auto& peer : peers) {
      for (int i = 0; i < rollouts; ++i) peer->MakeRollout();
    }
    Exchange();
    if (tick % 5 == 0) CheckExact();
  }
}

void Peers::Finish() {
  for (auto& peer : peers) peer->Finish();
}

void Peers::CheckView(const planner::WriterView& view,
                      const std::vector<planner::StatisticsRow>& rows) {
  if (!view.Converged()) return;
  ++agreements_;
  std::int64_t visits = 0;
  for (const auto& row : rows) {
    if (row.writer == view.id && row.path.empty()) visits = row.visits;
  }
  EXPECT_EQ(visits, view.announced.rollouts) << "writer " << view.id;
}

void Peers::CheckExact() {
  for (const auto& peer : peers) {
    const auto rows = peer->statistics().AllRows();
    for (const auto& row : rows) {
      ASSERT_TRUE(truth_.Knows(row))
          << "writer " << row.writer << " never had this row: " << planner::ToString(row.path)
          << " N " << row.visits;
    }
    const auto views = peer->statistics().writers();
    std::for_each(views.begin() + 1, views.end(),
                  [&](const planner::WriterView& view) { CheckView(view, rows); });
  }
}

bool Peers::Agreed() const {
  return std::all_of(peers.begin(), peers.end(), [&](const auto& peer) {
    const auto& statistics = peer->statistics();
    return statistics.writers().size() == kPeers && statistics.ConvergedWithLive() &&
           statistics.digest() == peers.front()->statistics().digest();
  });
}

int Peers::RoundsUntilAgreed() {
  std::vector<std::int64_t> before;
  for (const auto& peer : peers) before.push_back(peer->statistics().round_robin_rounds());
  const std::int64_t end_ms = services::SteadyMs() + 10000;
  while (!Agreed()) {
    if (services::SteadyMs() > end_ms) return -1;
    Exchange();
  }
  int most = 0;
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const auto rounds = peers[i]->statistics().round_robin_rounds() - before[i];
    most = std::max(most, static_cast<int>(rounds));
  }
  return most;
}

}  // namespace prospect::tests
