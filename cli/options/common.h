#pragma once

#include <cstdint>
#include <string>

#include "cli/fwd.h"

/// Options that many commands have, each with one wording.
namespace prospect::cli {

/// Seeds below are for training, calibration scenes lie from 1500000 to 1999999, and scenes from
/// 2000000 on are those that nothing was trained, chosen or calibrated on.
inline constexpr std::uint64_t kFirstUnseenSeed = 1'000'000, kFirstCalibrationSeed = 1'500'000,
                               kFirstReportedSeed = 2'000'000;

/// Adds --jobs: processes that share the work.
void DefineJobs(CLI::App& app, int& jobs);

/// Adds --threads: CPU threads of the networks.
void DefineThreads(CLI::App& app, int& threads);

/// Adds --seed from `least` on. @param what "first scene", say
void DefineSeed(CLI::App& app, std::uint64_t& seed, const std::string& what,
                std::uint64_t least = 0);

/// Adds --scenes. @param most that are possible
void DefineScenes(CLI::App& app, int& scenes, const std::string& what, int least = 1,
                  int most = 1'000'000);

/// Adds --out. @param what is written there
CLI::Option* DefineOut(CLI::App& app, std::string& out, const std::string& what,
                       const std::string& type = "DIR");

}  // namespace prospect::cli
