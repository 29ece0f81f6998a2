#pragma once

#include <cstdint>

#include "agent/record.h"
#include "services/executive/conversation.h"
#include "services/executive/options.h"

namespace prospect::services {

// What those who run many episodes, one after another, do between them.

/// Of a robot that is not told to begin an episode: waits for another than `last`, since what the
/// last one left is no new scene. Throws kExitTimeout.
void AwaitNewEpisode(Conversation& talk, std::int64_t last, const ExecutiveOptions& options);

/// An episode to its end, about which nothing is told. Whatever it throws, the robot is let go of.
agent::EpisodeRecord RunSilently(Conversation& talk, const ExecutiveOptions& options);

}  // namespace prospect::services
