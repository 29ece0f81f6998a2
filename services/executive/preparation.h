#pragma once

#include <string>

#include "lcmtypes/messages.h"
#include "services/executive/conversation.h"
#include "services/executive/options.h"

namespace prospect::services {

// What comes before the first search: services are there, the scene stands, the camera has looked.
// Each function waits, and throws an ExitError that says what is missing and how to start it.

/// Waits for a live simulator or robot (TASK), and for policy "search" also for a model server with
/// the right weights and the number of workers asked for. Throws kExitServiceLost naming the
/// missing ones.
void AwaitServices(Conversation& talk, const ExecutiveOptions& options);

/// Puts up the scene of options.seed as an episode with a name of its own, so that no picture of an
/// earlier one is taken for it, or takes the present one when options.reset is false. Throws
/// kExitTimeout when it does not appear.
void PrepareScene(Conversation& talk, const ExecutiveOptions& options);

/// The model server whose weights this episode uses: the one with options.weights_hash, or else the
/// first that lives and was made for this task. Throws kExitWeights when servers live but none
/// fits, kExitServiceLost when none lives.
model_info_t ChooseModel(Conversation& talk, const ExecutiveOptions& options);

/// Throws kExitUsage where another world is up than a person asked for.
void RequireWorld(Conversation& talk, const ExecutiveOptions& options);

/// The calibrations of this model's weights, as many as MODEL_INFO speaks of, and at least one
/// where `needed`. Throws kExitWeights when its servers do not say them within 5 s.
std::vector<model::CalibrationSample> AwaitCalibrations(Conversation& talk,
                                                        const model_info_t& model, bool needed);

/// Waits for the picture that shows the world after frame `frame` was taken. Throws kExitTimeout
/// when none comes within 5 s.
observation_t Look(Conversation& talk, std::int64_t frame);

}  // namespace prospect::services
