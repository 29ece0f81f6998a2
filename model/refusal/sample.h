#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace prospect::model {

/// What the oracle says of a scene (docs/worlds.md). Values as in CALIBRATION.
enum class SceneClass : std::uint8_t { kSolvable = 1, kHopeless = 2, kDoubtful = 3 };

/// How a scene ended when the best plan was carried out in closed loop, nothing refused for its
/// score. Values as in CALIBRATION.
enum class SceneEnding : std::uint8_t {
  kSolved = 1,
  kFailed = 2,
  kStopped = 3,  ///< given up after the first action: not solved, and nothing went wrong either
  kRefused = 4   ///< no plan at all: every future was given up, so no threshold brings one back
};

/// One scene that was kept for calibration.
struct CalibrationScene {
  double score = 0;  ///< of the first search's plan, 0..1; 0 when there was none
  SceneClass scene_class = SceneClass::kSolvable;
  SceneEnding ending = SceneEnding::kSolved;

  bool attempted() const { return ending != SceneEnding::kRefused; }
};

/// How plans of some weights fared on scenes drawn like those to come; from it a threshold for any
/// promise is chosen (promise.h). A promise is about beginning: whether the first search's plan is
/// acted on. Later searches of an episode are held to the same threshold, which may stop it, or
/// have a lost plan begun anew, where the sample went on.
struct CalibrationSample {
  double refusal_threshold = 0;  ///< the weights' own for such scenes: what scores less is refused
  std::vector<CalibrationScene> scenes;  ///< scores ascending
  std::string rule;                      ///< of the searches
  /// Of the searches and their task, by name: samples, v_failed, c_done, p_min, plan_length. A
  /// search by others is not covered.
  std::map<std::string, double> parameters;

  bool empty() const { return scenes.empty(); }
};

}  // namespace prospect::model
