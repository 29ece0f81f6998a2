#pragma once

#include <string>

#include "sim/tabletop/scene_description.h"
#include "sim/tabletop/yaml_reader.h"

namespace prospect::sim {

// The text of the stacking scene that was compiled in (config/scenes/stacking.yaml).
const char* DefaultStackingScene();

// The root of a scene file: `path`, or the compiled-in stacking scene if `path` is empty. Throws
// SceneFileError if it cannot be read or is no YAML map.
YamlReader OpenSceneFile(const std::string& path);

// Arm, gripper, blocks, obstacle, cameras, light and physics of a scene file. Throws SceneFileError
// naming the entry that is missing, misspelt or out of range.
TabletopDescription ReadTabletop(const YamlReader& root);

// Names what a file says, comments and layout apart: 16 hexadecimal digits. `revision` is raised by
// hand when code changes what a scene does.
std::string SceneHash(const YamlReader& root, int revision);

}  // namespace prospect::sim
