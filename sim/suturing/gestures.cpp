#include "sim/suturing/gestures.h"

#include <algorithm>
#include <string>

namespace prospect::sim {
namespace {

struct Words {
  const char* kind;
  const char* object;
};

constexpr Words kWords[kGestures] = {{"reach with right hand", "needle"},
                                     {"position", "needle"},
                                     {"push through tissue", "needle"},
                                     {"transfer from left to right", "needle"},
                                     {"move to center", "needle"},
                                     {"pull with left hand", "suture"},
                                     {"pull with right hand", "suture"},
                                     {"orient", "needle"},
                                     {"tighten with right hand", "suture"},
                                     {"loosen", "suture"},
                                     {"drop and move to end points", "suture"},
                                     {"reach with left hand", "needle"},
                                     {"make a C loop", "suture"},
                                     {"reach with right hand", "suture"},
                                     {"pull with both hands", "suture"}};

struct Step {
  int from;
  int to;
  double weight;
};

// The chain. Weights of one row need not sum to 1: those of illegal steps drop out.
constexpr Step kChain[] = {
    {kGestures, kReachRight, 1.0}, {kReachRight, kCenter, 0.85}, {kReachRight, kOrient, 0.15},
    {kCenter, kPosition, 0.8},     {kCenter, kOrient, 0.2},      {kOrient, kPosition, 1.0},
    {kPosition, kPush, 1.0},       {kPush, kPullLeft, 1.0},      {kPullLeft, kTransfer, 0.75},
    {kPullLeft, kTighten, 0.15},   {kPullLeft, kLoosen, 0.10},   {kPullLeft, kDrop, 3.0},
    {kTighten, kTransfer, 0.7},    {kTighten, kPullLeft, 0.1},   {kTighten, kLoosen, 0.2},
    {kTighten, kDrop, 3.0},        {kLoosen, kTransfer, 0.8},    {kLoosen, kPullLeft, 0.2},
    {kLoosen, kDrop, 3.0},         {kTransfer, kPosition, 0.65}, {kTransfer, kOrient, 0.25},
    {kTransfer, kCenter, 0.10},
};

double Weight(int from, int to, bool done) {
  if (to == kDrop && !done) return 0;
  for (const Step& step : kChain) {
    if (step.from == from && step.to == to) return step.weight;
  }
  return 0;
}

}  // namespace

std::vector<ActionSpec> SuturingActions() {
  std::vector<ActionSpec> actions;
  for (int i = 0; i < kGestures; ++i) {
    actions.push_back({i, "G" + std::to_string(i + 1), kWords[i].kind, kWords[i].object});
  }
  return actions;
}

std::vector<std::vector<int>> SuturingSuccessors() {
  std::vector<std::vector<int>> successors(kGestures + 1);
  for (const Step& step : kChain) successors[step.from].push_back(step.to);
  for (std::vector<int>& row : successors) std::sort(row.begin(), row.end());
  return successors;
}

int ChooseGesture(int last, const std::vector<int>& legal, bool done, base::Random* random) {
  double total = 0;
  for (int next : legal) total += Weight(last, next, done);
  double left = random->Uniform() * total;
  for (int next : legal) {
    left -= Weight(last, next, done);
    if (left < 0) return next;
  }
  return legal.back();
}

}  // namespace prospect::sim
