#pragma once

#include <cstdint>

#include "services/executive/command_line.h"
#include "services/executive/conversation.h"
#include "services/executive/trial_counts.h"

namespace prospect::services {

/// Carries out trials with random plans, one after another, until as many as call.episodes were
/// made in all; those of earlier calls with the same call.options.out count, too. Trial n is of
/// scene options.seed + n where whoever is on the bus puts scenes up. With call.pause each begins
/// when Enter was typed, for a person who tidies the table meanwhile. Tells the running count once
/// a second at most.
/// @return the counts, which are written to trials.json after each trial
/// Throws ExitError as BusEpisode does; kExitTimeout, too, where no new episode begins, and
/// kExitInterrupted where nobody can type Enter any more.
TrialCounts RunTrials(Conversation& talk, const ExecutiveCall& call);

}  // namespace prospect::services
