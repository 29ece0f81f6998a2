#include "services/model/request_queue.h"

#include <gtest/gtest.h>

#include "services/binding/evaluation_messages.h"
#include "services/model/serving_statistics.h"

namespace prospect::services {
namespace {

expand_request_t Request(std::int64_t id, const std::vector<planner::Path>& paths,
                         std::int64_t budget_ms = -1) {
  expand_request_t request{};
  request.client_id = 1;
  request.request_id = id;
  request.search_id = 5;
  request.epoch = 2;
  request.budget_ms = budget_ms;
  for (const auto& path : paths) request.paths.push_back(ToMessage(path));
  return request;
}

TEST(RequestQueueTest, RepeatsDoNotFillTheQueue) {
  RequestQueue queue(10);
  EXPECT_TRUE(queue.Put(Request(1, {{0}, {1}}), 0));
  EXPECT_TRUE(queue.Put(Request(1, {{0}, {1}}), 5));
  EXPECT_EQ(queue.paths(), 2u);
}

TEST(RequestQueueTest, FullQueueTakesNothing) {
  RequestQueue queue(3);
  EXPECT_TRUE(queue.Put(Request(1, {{0}, {1}}), 0));
  EXPECT_FALSE(queue.Put(Request(2, {{0}, {1}}), 0));
  EXPECT_EQ(queue.paths(), 2u);
}

TEST(RequestQueueTest, CancelTakesOlderEpochsOnly) {
  RequestQueue queue(10);
  queue.Put(Request(1, {{0}}), 0);
  queue.Cancel(5, 2);
  EXPECT_EQ(queue.paths(), 1u);
  queue.Cancel(6, 9);
  EXPECT_EQ(queue.paths(), 1u);
  queue.Cancel(5, 3);
  EXPECT_TRUE(queue.empty());
}

TEST(RequestQueueTest, ExpiredRequestsGo) {
  RequestQueue queue(10);
  queue.Put(Request(1, {{0}}, 50), 100'000);
  queue.Put(Request(2, {{1}}), 100'000);
  queue.Expire(150'000);
  EXPECT_EQ(queue.paths(), 2u);
  queue.Expire(150'001);
  EXPECT_EQ(queue.paths(), 1u);
}

TEST(ServingStatisticsTest, HistogramAndMeans) {
  ServingStatistics statistics(4);
  statistics.NoteBatch(1, 2.0, {0.1});
  statistics.NoteBatch(9, 4.0, {0.2, 1000});
  statistics.NoteBatch(0, 100.0, {});
  statistics.NoteHits(6);
  model_info_t info{};
  statistics.Fill(&info);
  EXPECT_EQ(info.batch_histogram, (std::vector<std::int64_t>{1, 0, 0, 1}));
  EXPECT_EQ(info.evaluations, 10);
  EXPECT_EQ(info.cache_hits, 6);
  EXPECT_DOUBLE_EQ(info.batch_ms, 3.0);
  EXPECT_EQ(info.batches, 2);
  EXPECT_DOUBLE_EQ(info.compute_seconds, 0.006);
}

TEST(ServingStatisticsTest, TimesAreCountedByDoublings) {
  EXPECT_EQ(ServingStatistics::TimeBin(0), 0u);
  EXPECT_EQ(ServingStatistics::TimeBin(0.125), 1u);
  EXPECT_EQ(ServingStatistics::TimeBin(0.3), 2u);
  EXPECT_EQ(ServingStatistics::TimeBin(1e9), ServingStatistics::kTimeBins - 1);
  ServingStatistics statistics(4);
  statistics.NoteBatch(2, 1.0, {0.05, 0.3});
  statistics.NoteAnswer(0.2);
  model_info_t info{};
  statistics.Fill(&info);
  EXPECT_EQ(info.age_histogram.at(0), 1);
  EXPECT_EQ(info.age_histogram.at(2), 1);
  EXPECT_EQ(info.latency_histogram.at(1), 1);
}

}  // namespace
}  // namespace prospect::services
