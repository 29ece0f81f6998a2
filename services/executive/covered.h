#pragma once

#include <string>

#include "lcmtypes/messages.h"
#include "model/refusal/scene_kind.h"

namespace prospect::services {

/// What kind of scene the task and its label tell of; without a label, the objects are not known. A
/// pure function.
model::SceneKind KindOf(const task_t& task, const label_t* label);

}  // namespace prospect::services
