#pragma once

#include <string>

/// What is said of a picture that may be unlike the known ones (model/novelty.h): plain data and
/// words, without networks, so that a process that only hears of it can say it.
namespace prospect::model {

/// How unlike known pictures one is. Distances are root mean squares in units of the spread of
/// known pictures along their principal axes (Mahalanobis), so that usual ones are near 1.
struct Novelty {
  double p = 1;            ///< conformal p-value: see NoveltyGauge::Judge
  double error = 0;        ///< NoveltySample::error
  double error_limit = 0;  ///< 99 % of known pictures stay below; so for the other two
  double residual = 0;     ///< distance of NoveltySample::residual
  double residual_limit = 0;
  double state = 0;  ///< distance of NoveltySample::state
  double state_limit = 0;
};

/// Why a picture is taken for an unknown one, by what stands out more of the two: "p 0.002: it
/// cannot be redrawn: error 0.051, 99 % of known pictures stay below 0.022".
std::string DescribeNovelty(const Novelty& novelty);

/// The sentence with which a picture is refused.
std::string NoveltyRefusal(const Novelty& novelty);

/// Pictures with a smaller p-value are refused unless somebody wants otherwise.
inline constexpr double kNoveltyLevel = 0.01;

}  // namespace prospect::model
