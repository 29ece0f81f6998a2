#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace prospect::model {

/// What held-out scores (ComputeScores) say in words: a row for the pictures and for each of V, f,
/// p, Q and whole plans, beside the answer that takes no learning, and whether it is better than
/// that; then one sentence about all of them. Lines end with '\n'.
std::string Verdict(const nlohmann::json& scores);

/// A row of it. `scores` of pictures: mae_changed and copy_mae_changed; of a network that tells two
/// kinds of cases apart: balanced_accuracy, brier, trivial_brier, base_rate, samples.
std::string PictureVerdict(const std::string& what, const nlohmann::json& scores);
std::string HeadVerdict(const std::string& what, const nlohmann::json& scores);

/// For which actions f was not shown to be learned, by examples that were held out, and which
/// examples are so few that more of them would help most. `actions`: scores as HeadVerdict takes
/// them, each with a name. Empty where all were learned.
std::string ActionVerdict(const nlohmann::json& actions);

}  // namespace prospect::model
