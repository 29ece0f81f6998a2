#pragma once

#include "lcmtypes/messages.h"
#include "model/novelty_words.h"

namespace prospect::services {

// How unlike the known pictures a search's root is, between the wire and the model room: field by
// field. Pure functions, safe from any thread.

novelty_t ToMessage(const model::Novelty& novelty);
model::Novelty FromMessage(const novelty_t& message);

}  // namespace prospect::services
