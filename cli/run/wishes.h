#pragma once

#include <string>

#include "cli/options/episode.h"
#include "cli/run/invocation.h"

namespace prospect::cli {

/// What a deployment that is up must be for an episode, as `prospect-supervisor join` takes it.
Words WishesOf(const EpisodeOptions& episode, const std::string& weights);

/// @throws ExitError (kExitUsage) for what is not this task's
void RequireScene(const SceneOptions& scene, const std::string& task);

}  // namespace prospect::cli
