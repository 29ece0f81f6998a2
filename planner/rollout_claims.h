// How workers that hear each other late, or not at all, begin no more rollouts than were asked for.
// Each worker announces a claim: how many rollouts it may begin in all. It never begins more, and a
// claim only grows. A worker renews its claim (round k to k + 1) when its last one was announced
// and every live peer was heard at round k or later, to
//
//   max(claim, begun + ceil((samples - claims of peers - begun) / (2 W)))      W: live workers
//
// at most. Since all claims of round k + 1 are computed from claims of round k or newer, and each
// takes at most a 2 W-th of what those left over (rounded up), their sum stays below samples + W,
// however late, often or out of order messages come: induction over rounds. Taking a part of what
// is left and not all leaves something for whoever turns out to be faster (guided self-scheduling:
// Polychronopoulos and Kuck 1987).
//
// A first claim is small, and a renewed one at most doubles what the worker has begun, so that
// workers that start at the same time find each other before much is given away. A peer not
// heard for kPatienceUs after a renewal does not hold the others up: they renew without it, and set
// aside as much for it as for themselves. A peer whose lease ended or that has finished counts with
// what it completed. What remains is what joins or is split off unheard: in practice the samples
// are overshot by at most kFirstClaim a worker, up to 30 % loss
// (tests/unit/planner/rollout_claims_test).
//
// Plain value; not thread safe; time is an argument, on any steady clock in microseconds.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/shared_statistics.h"

namespace prospect::planner {

class RolloutClaims {
 public:
  static constexpr std::int64_t kFirstClaim = 2;
  static constexpr std::int64_t kPatienceUs = 200'000;

  explicit RolloutClaims(std::int64_t samples) : samples_(samples) {}

  // Whether one more rollout may begin, `begun` (own N + O) having begun already. Always true until
  // the first Share: a search that talks to nobody needs no claim.
  bool Covers(std::int64_t begun) const { return !shared_ || begun < claimed_; }

  // Others may be there from now on. Idempotent.
  void Share(std::int64_t begun, std::int64_t now_us);

  // Renews the claim if that is allowed now. `peers`: all other writers known.
  void Renew(std::int64_t begun, const std::vector<WriterView>& peers, std::int64_t now_us);

  // The present claim goes out in a batch.
  void NoteAnnounced() { announced_ = true; }
  // The claim or its round has changed since it was last announced.
  bool news() const { return shared_ && !announced_; }

  std::int64_t claimed() const { return claimed_; }
  std::int64_t round() const { return round_; }

 private:
  struct Peers;
  Peers Survey(const std::vector<WriterView>& peers) const;

  std::int64_t samples_;
  bool shared_ = false;
  bool announced_ = false;
  std::int64_t claimed_ = 0;
  std::int64_t round_ = 0;
  std::int64_t renewed_us_ = 0;
};

}  // namespace prospect::planner
