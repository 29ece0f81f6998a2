#include "agent/familiarity.h"

#include "base/number_format.h"

namespace prospect::agent {

std::string FamiliaritySentence(const Familiarity& familiarity) {
  if (familiarity.foreign())
    return "It is unlike what the networks were trained on: " +
           model::DescribeNovelty(familiarity.novelty) + ".";
  return base::Number("The picture is like known ones (p %.2g).", familiarity.novelty.p);
}

}  // namespace prospect::agent
