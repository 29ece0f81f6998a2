#pragma once

#include <string>

#include "agent/picture.h"
#include "model/novelty_words.h"

namespace prospect::agent {

/// Whether the picture an episode began with is one that the networks know how to read.
struct Familiarity {
  model::Novelty novelty;
  double level = model::kNoveltyLevel;  ///< pictures with a smaller p are refused
  Picture seen;                         ///< what was judged
  Picture redrawn;                      ///< what the networks make of it; empty: did not come

  bool foreign() const { return novelty.p < level; }
};

/// One sentence for a person: "The picture is like known ones (p 0.43).", or what is unusual about
/// it.
std::string FamiliaritySentence(const Familiarity& familiarity);

}  // namespace prospect::agent
