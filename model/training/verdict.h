#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace prospect::model {

/// What held-out scores (ComputeScores) say in words: a row for the pictures and for each of V, f,
/// p, Q and whole plans, beside the answer that takes no learning, and whether it is better than
/// that; then one sentence about all of them. Lines end with '\n'.
std::string Verdict(const nlohmann::json& scores);

}  // namespace prospect::model
