#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "sim/suturing/parameters.h"
#include "sim/suturing/phases.h"
#include "sim/suturing/suturing_world.h"

namespace prospect::sim {

// Carries a gesture out: phase after phase it moves both hands along their ways, opens and shuts
// the jaws, and lets the phases' events happen. What can go wrong: jaws close beside the needle
// ("missed(needle)"), a hand loses it ("dropped(needle)"), it is set too far from its dot
// ("missed(entry)"), or a gesture takes too long ("time").
//
// Plain data between calls: copying it saves it.
class GesturePlayer {
 public:
  // Holds still where the hands are.
  void Rest(const SuturingWorld& world);

  // Begins `gesture`; all its deviations come from `seed`.
  void Begin(int gesture, std::uint64_t seed, const SuturingWorld& world, Suture* suture,
             const SuturingParameters& p, const SurgeonStyle& style);

  // Gives the gesture up: the hands stop where they are.
  void Stop(const SuturingWorld& world);

  // Sets the motors for the next physics step and lets happen what is due. True while the gesture
  // goes on; then failure() says whether it ended well.
  bool Control(SuturingWorld* world, Suture* suture, const SuturingParameters& p,
               const SurgeonStyle& style);

  const std::string& failure() const { return failure_; }  // empty: none
  bool running() const { return running_; }

 private:
  bool NextPhase(const SuturingWorld& world, const Suture& suture, const SuturingParameters& p,
                 const SurgeonStyle& style);
  void Steer(SuturingWorld* world, const SuturingParameters& p) const;
  bool Arrived(const SuturingWorld& world, const SuturingParameters& p) const;
  void Happen(SuturingWorld* world, Suture* suture, const SuturingParameters& p);
  void Take(int hand, SuturingWorld* world, const SuturingParameters& p);
  void PullThread(const SuturingWorld& world, Suture* suture, const SuturingParameters& p) const;
  void MaybeLose(SuturingWorld* world, const Suture& suture, const SuturingParameters& p);
  bool Fail(const std::string& why, const SuturingWorld& world);

  bool running_ = false;
  int gesture_ = 0;
  int index_ = -1;
  std::uint64_t seed_ = 0;
  bool began_in_tissue_ = false;
  double total_ = 0;        // s since the gesture began
  double elapsed_ = 0;      // s since the phase began
  double clock_ = 0;        // s since the first Rest, for tremor
  double lose_at_ = -1;     // s into the gesture at which the needle slips; < 0: never
  double lost_ = -1;        // s since it did; < 0: it did not
  double feed_before_ = 0;  // the thread's, when the phase began
  Eigen::Vector3d end_before_ = Eigen::Vector3d::Zero();
  Phase phase_;
  std::string failure_;
};

}  // namespace prospect::sim
