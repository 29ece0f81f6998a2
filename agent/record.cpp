#include "agent/record.h"

namespace prospect::agent {

void NameScene(const EpisodeRecord& record, Explanation* explanation) {
  explanation->task = record.task;
  explanation->seed = record.seed;
  explanation->weights = record.weights;
  explanation->engine = record.engine;
  explanation->goal = record.goal;
  explanation->not_covered = record.not_covered;
  explanation->seen = record.first;
}

}  // namespace prospect::agent
