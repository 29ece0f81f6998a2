#pragma once

#include <string>
#include <utility>
#include <vector>

#include "agent/picture.h"

namespace prospect::agent {

/// What the plan that is followed imagined to see after each of its steps, for comparing it with
/// what is seen (model/surprise.h). Plain data.
class Course {
 public:
  struct Step {
    std::string name;
    Picture imagined;  ///< empty: it could not be had
  };

  void Set(std::vector<Step> steps) { steps_ = std::move(steps); }

  /// The first step, but for the last (when the plan is over, nothing is compared any more), after
  /// which there is no picture of this size to compare with: "step 2, grasp(green)". Empty: none.
  std::string Gap(int width, int height) const;

  /// How far `seen` is from what was imagined for after the first `done` steps, 0 to 1; 0 before
  /// the first and where there is nothing to compare with.
  double SurpriseAfter(int done, const Picture& seen) const;

 private:
  std::vector<Step> steps_;
};

}  // namespace prospect::agent
