#pragma once

#include <optional>
#include <string>

#include "model/novelty_words.h"

namespace prospect::services {

// How unlike the known pictures a search's root is, as a model server tells it: in `reason` of an
// OK PREDICT_REPLY for the empty path, as "p=0.002 error=0.051 ..." with a number for each field of
// model::Novelty. Empty where the server's weights hold nothing of known pictures.

std::string NoveltyText(const model::Novelty& novelty);

/// nullopt where `text` is not such a text, whole and in order, or holds what is not a number.
std::optional<model::Novelty> NoveltyFrom(const std::string& text);

}  // namespace prospect::services
