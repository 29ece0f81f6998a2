#pragma once

#include "cli/commands/evaluate.h"

namespace prospect::tools {

// What prospect-evaluate carries out. Each returns the exit code; throws ExitError,
// std::invalid_argument.

/// Closed loop on scenes that nothing was trained or tuned on, with the oracle's verdict and plain
/// baselines beside the planner.
int RunEvaluate(const cli::EvaluateOptions& options);

/// Does the model know which plans work? All plans of unseen scenes are scored by the networks and
/// each is really carried out many times.
int RunPlans(const cli::EvaluatePlansOptions& options);

/// What a planner does when pictures are not like those it was trained on: light, camera angle,
/// colours and noise at five strengths each, open loop.
int RunShifts(const cli::EvaluateShiftsOptions& options);

/// What the networks say of recorded trials, beside what came of them; needs no simulator.
int RunData(const cli::EvaluateDataOptions& options);

/// Closed loop with whatever is on a bus; planner, random plans and greedy steps on equal scenes.
int RunOnBus(const cli::EvaluateOnBusOptions& options);

/// Finds the refusal threshold and stores it in the weights, with the sample that it comes from. Of
/// another goal than the task's own the threshold is told and not stored.
int RunCalibrate(const cli::CalibrateOptions& options);

/// Shows the networks the first pictures of calibration scenes, and stores in the weights how well
/// known pictures are redrawn and where their hidden states lie.
int RunNovelty(const cli::NoveltyOptions& options);

/// Whether the promises about refusals hold, from scenes that were evaluated before: a threshold
/// from a random half of them, tried on the other half, many times. Nothing is simulated.
int RunRefusals(const cli::RefusalsOptions& options);

}  // namespace prospect::tools
