// Claims on a simulated bus that loses, delays and reorders: never more rollouts than asked for,
// but for a few a worker, and never a standstill.
#include "planner/rollout_claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace prospect::planner {
namespace {

struct Message {
  std::int64_t arrival_us;
  int to;
  int from;
  WriterTotals totals;
};

struct Worker {
  explicit Worker(std::int64_t samples) : claims(samples) {}
  RolloutClaims claims;
  std::int64_t begun = 0;
  std::int64_t next_tick_us = 0;
  bool announced = false;
  int each = 1;  // rollouts it can begin in a millisecond
  std::map<int, WriterView> peers;
};

struct Setting {
  int workers = 4;
  std::int64_t samples = 200;
  double loss = 0;
  std::int64_t latest_us = 500;  // messages take up to this long
  int fastest = 3;
};

class Bus {
 public:
  Bus(const Setting& setting, unsigned seed) : setting_(setting), random_(seed) {
    for (int i = 0; i < setting.workers; ++i) {
      Worker& worker = workers_.emplace_back(setting.samples);
      worker.next_tick_us = Draw(40'000);
      worker.each = 1 + static_cast<int>(Draw(setting.fastest - 1));
    }
  }

  std::int64_t Begun() const {
    std::int64_t sum = 0;
    for (const Worker& worker : workers_) sum += worker.begun;
    return sum;
  }
  std::int64_t now_us() const { return now_us_; }

  void RunUntilDone(std::int64_t limit_us) {
    for (; Begun() < setting_.samples && now_us_ < limit_us; now_us_ += 1000) Step();
    for (int more = 0; more < 100; ++more, now_us_ += 1000) Step();  // nor does anybody go on
  }

 private:
  std::int64_t Draw(std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(0, most)(random_);
  }

  void Step() {
    Receive();
    for (int i = 0; i < setting_.workers; ++i) Turn(i);
  }

  void Receive() {
    for (const Message& message : under_way_) {
      if (message.arrival_us > now_us_) continue;
      WriterView& view = workers_[message.to].peers[message.from];
      if (view.live && message.totals.evaluations <= view.announced.evaluations) continue;
      view.id = static_cast<std::uint64_t>(message.from) + 1;
      view.live = true;
      view.announced = message.totals;
    }
    under_way_.erase(
        std::remove_if(under_way_.begin(), under_way_.end(),
                       [this](const Message& message) { return message.arrival_us <= now_us_; }),
        under_way_.end());
  }

  std::vector<WriterView> PeersOf(const Worker& worker) const {
    std::vector<WriterView> peers;
    for (const auto& [from, view] : worker.peers) peers.push_back(view);
    return peers;
  }

  void Turn(int index) {
    Worker& worker = workers_[index];
    if (now_us_ >= worker.next_tick_us) Announce(index);
    if (!worker.announced) return;  // as a worker's loop does: first it says that it is there
    for (int i = 0; i < worker.each; ++i) {
      if (!worker.claims.Covers(worker.begun)) {
        worker.claims.Renew(worker.begun, PeersOf(worker), now_us_);
        if (worker.claims.news()) Announce(index);
      }
      if (worker.claims.Covers(worker.begun)) ++worker.begun;
    }
  }

  void Announce(int index) {
    Worker& worker = workers_[index];
    worker.next_tick_us = now_us_ + 40'000;
    worker.announced = true;
    worker.claims.Share(worker.begun, now_us_);
    worker.claims.Renew(worker.begun, PeersOf(worker), now_us_);
    worker.claims.NoteAnnounced();
    WriterTotals totals;
    totals.claimed = worker.claims.claimed();
    totals.round = worker.claims.round();
    totals.rollouts = worker.begun;
    totals.evaluations = ++announcements_;  // tells newer from older
    for (int to = 0; to < setting_.workers; ++to) {
      const bool lost = std::uniform_real_distribution<double>(0, 1)(random_) < setting_.loss;
      if (to == index || lost) continue;
      under_way_.push_back({now_us_ + Draw(setting_.latest_us), to, index, totals});
    }
  }

  Setting setting_;
  std::mt19937 random_;
  std::vector<Worker> workers_;
  std::vector<Message> under_way_;
  std::int64_t announcements_ = 0;
  std::int64_t now_us_ = 1000;
};

void ExpectBound(const Setting& setting, std::int64_t slack, std::int64_t limit_us) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Bus bus(setting, seed);
    bus.RunUntilDone(limit_us);
    EXPECT_GE(bus.Begun(), setting.samples) << "a standstill, seed " << seed;
    EXPECT_LE(bus.Begun(), setting.samples + slack) << "seed " << seed;
  }
}

TEST(RolloutClaims, OnlyThoseWhoShareNeedAClaim) {
  RolloutClaims claims(100);
  EXPECT_TRUE(claims.Covers(1'000'000));
  claims.Share(0, 0);
  EXPECT_TRUE(claims.Covers(1));
  EXPECT_FALSE(claims.Covers(2));
}

TEST(RolloutClaims, AClaimIsRenewedOnceItWasAnnounced) {
  RolloutClaims claims(100);
  claims.Share(0, 0);
  claims.Renew(2, {}, 0);
  EXPECT_EQ(claims.claimed(), 2);
  claims.NoteAnnounced();
  claims.Renew(2, {}, 0);
  EXPECT_EQ(claims.claimed(), 4);
  EXPECT_TRUE(claims.news());
}

TEST(RolloutClaims, APeerThatWasNotHeardHoldsUpForAWhileOnly) {
  RolloutClaims claims(100);
  claims.Share(0, 0);
  claims.NoteAnnounced();
  WriterView peer;
  peer.live = true;
  peer.announced.claimed = 2;
  claims.Renew(2, {peer}, 0);
  EXPECT_EQ(claims.round(), 1);
  claims.NoteAnnounced();
  claims.Renew(4, {peer}, RolloutClaims::kPatienceUs - 1);
  EXPECT_EQ(claims.round(), 1);
  claims.Renew(4, {peer}, RolloutClaims::kPatienceUs);
  EXPECT_EQ(claims.round(), 2);
  EXPECT_EQ(claims.claimed(), 8);
}

// What a dead or finished peer did not do is there for the others.
TEST(RolloutClaims, ASilentPeersClaimReturns) {
  for (const bool finished : {false, true}) {
    RolloutClaims claims(40);
    claims.Share(20, 0);
    claims.NoteAnnounced();
    WriterView peer;
    peer.live = finished;
    peer.announced.finished = finished;
    peer.announced.claimed = 20;
    peer.rollouts = 5;
    claims.Renew(20, {peer}, 0);
    EXPECT_EQ(claims.claimed(), 28);  // half of the 15 that are left
  }
}

TEST(RolloutClaims, NoOvershootOnAGoodBus) {
  for (const int workers : {1, 2, 4, 16}) {
    Setting setting;
    setting.workers = workers;
    ExpectBound(setting, RolloutClaims::kFirstClaim * workers, 10'000'000);
  }
}

TEST(RolloutClaims, FewSamplesAndManyWorkers) {
  Setting setting;
  setting.workers = 8;
  setting.samples = 30;
  ExpectBound(setting, 2 * setting.workers, 10'000'000);
}

TEST(RolloutClaims, LossAndDelayCostTimeAndNoOvershoot) {
  for (const double loss : {0.0, 0.3, 0.6}) {
    Setting setting;
    setting.loss = loss;
    setting.latest_us = 30'000;
    // Beyond 30 % loss a peer is often silent for longer than workers wait for it.
    const std::int64_t each = loss > 0.3 ? 4 : RolloutClaims::kFirstClaim;
    ExpectBound(setting, each * setting.workers, 60'000'000);
  }
}

}  // namespace
}  // namespace prospect::planner
