#pragma once

#include <string>

#include "agent/explanation.h"

namespace prospect::agent {

/// "Act" or "Refuse", with the score and what it is compared with.
std::string Headline(const Explanation& explanation);
std::string ScoreSentence(const Explanation& explanation);

/// For a terminal: verdict, chosen plan, the best `most` alternatives and the plan a person named.
std::string ExplanationText(const Explanation& explanation, int most = 3);

}  // namespace prospect::agent
