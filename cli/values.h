#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

/// Checks of values, for option->transform(...) or ->check(...). What is wrong is said in words
/// that name the option, the value and what is allowed; the help gets the range from here, too.
/// Files are not looked at here: whether one is there is the program's to say (exit code 14, 10 or
/// 13).
namespace prospect::cli {

/// A whole number from `least` to `most`, in decimals: 08 is eight, 0x10 is nothing.
CLI::Validator Whole(std::int64_t least, std::int64_t most);

/// The largest seed of a scene.
inline constexpr std::int64_t kLargestSeed = 999'999'999'999'999'999;

/// A number from `least` to `most`.
CLI::Validator Real(double least, double most);

/// A share between 0 and 1, such as 0.05, but neither of both.
CLI::Validator Share();

/// A goal that planner::ParseGoal reads; whether a task knows its names shows later.
CLI::Validator Goal();

/// search, collect, expert or plan:A,B,... (numbers of actions).
CLI::Validator Policy();

/// Names of actions, parted by commas: "align(green),grasp(green)".
CLI::Validator PlanOfNames();

/// I/N: one of N parts, 1 <= I <= N <= 1000.
CLI::Validator PartOfParts();

/// One of these words.
CLI::Validator OneOf(const std::vector<std::string>& words);

}  // namespace prospect::cli
