#pragma once

#include <string>

#include "cli/options/scene.h"
#include "cli/options/start.h"
#include "cli/run/deployment.h"

/// What an episode takes place in: weights, scene, key.
namespace prospect::cli {

/// The weights file that is meant: a file, the task's own in a folder, "scripted"; the bundled ones
/// where none is named. @throws ExitError (kExitWeights)
std::string WeightsThere(const std::string& wish, const std::string& task);

/// What the simulator is started with. @throws ExitError (kExitDataFile) without its scene file
Words SceneArguments(const SceneOptions& scene, const StartOptions& start, const std::string& task);

/// "--world HASH" for the executive, of a scene file of one's own: the episode is of that world or
/// of none. What is wrong in the file is told before anything starts. Empty without one.
/// @throws ExitError, Ended
Words WorldArguments(const SceneOptions& scene, const std::string& task);

/// Whoever is started from here on has this key; empty: the environment's. @throws ExitError
/// (kExitDataFile) when it cannot be read
void TakeKey(const std::string& key);

}  // namespace prospect::cli
