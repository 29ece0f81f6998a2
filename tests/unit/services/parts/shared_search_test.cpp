#include "services/binding/shared_search.h"

#include <gtest/gtest.h>

#include "services/binding/evaluation_messages.h"
#include "services/binding/search_messages.h"
#include "services/binding/statistics_messages.h"

namespace prospect::services {
namespace {

search_root_t Root(bool sharing) {
  planner::SearchParameters parameters;
  parameters.samples = 20;
  parameters.depth = 2;
  search_root_t root{};
  SetParameters(parameters, &root);
  root.search_id = 5;
  root.epoch = 1;
  root.weights_hash = 9;
  root.budget_ms = -1;
  root.sharing = sharing ? 1 : 0;
  return root;
}

expand_reply_t RootEvaluated() {
  expand_reply_t reply{};
  reply.search_id = 5;
  reply.epoch = 1;
  reply.weights_hash = 9;
  planner::Evaluation evaluation;
  evaluation.value = 0.5f;
  evaluation.q = evaluation.p = {0.5f, 0.5f, 0.5f};
  reply.evaluations = {ToMessage({}, evaluation, {0, 1, 2})};
  return reply;
}

SharedSearch Make(bool sharing) {
  return SharedSearch(Root(sharing), planner::AnyOrder(3, 2), 11, 0, 0);
}

TEST(SharedSearchTest, TakesEvaluationsOfItsSearchOnly) {
  auto shared = Make(true);
  auto other_epoch = RootEvaluated(), other_weights = RootEvaluated();
  other_epoch.epoch = 2;
  other_weights.weights_hash = 10;
  shared.Hear(other_epoch);
  shared.Hear(other_weights);
  EXPECT_EQ(shared.search().known_evaluations(), 0);
  shared.Hear(RootEvaluated());
  EXPECT_EQ(shared.search().known_evaluations(), 1);
}

TEST(SharedSearchTest, ApartOnlyWhatWasAskedForCounts) {
  auto shared = Make(false);
  RequestWindow window(11);
  window.Begin(Root(false));
  shared.Hear(RootEvaluated(), &window);
  EXPECT_EQ(shared.search().known_evaluations(), 0);
  ServerList nobody;
  window.Ask({{}}, nobody, 0);
  shared.Hear(RootEvaluated(), &window);
  EXPECT_EQ(shared.search().known_evaluations(), 1);
}

TEST(SharedSearchTest, UnsoundEvaluationsAreCounted) {
  auto shared = Make(true);
  auto reply = RootEvaluated();
  reply.evaluations[0].path.actions = {1, 1};
  shared.Hear(reply);
  EXPECT_EQ(shared.refused_evaluations(), 1);
}

// Rows of one worker reach an observer through the wire's form.
TEST(SharedSearchTest, ObserverSeesAWorkersRollouts) {
  auto worker = Make(true);
  SharedSearch observer(Root(true), planner::AnyOrder(3, 2), 12, 0, 0);
  worker.Hear(RootEvaluated());
  observer.Hear(RootEvaluated());
  worker.search().Advance(1, 0);
  auto batch = ToMessage(worker.search().MakeBatch(8192, 1000), kLeaseMs);
  observer.Hear(batch, 2000);
  const auto& totals = observer.search().statistics().totals(0);
  EXPECT_EQ(totals.visits + totals.in_flight, 1);
  EXPECT_EQ(observer.search().statistics().refusals().checksum, 0);
}

}  // namespace
}  // namespace prospect::services
