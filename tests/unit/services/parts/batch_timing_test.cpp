#include "services/model/batch_timing.h"

#include <gtest/gtest.h>

namespace prospect::services {
namespace {

// A server whose batches take 4 ms + 0.02 ms a row.
BatchTiming FixedCost() {
  BatchTiming timing;
  for (int i = 0; i < 100; ++i) {
    const int rows = 1 + i % 16;
    timing.NoteBatch(rows, 4000 + 20 * rows);
  }
  return timing;
}

TEST(BatchTimingTest, LearnsWhatABatchAndARowCost) {
  const BatchTiming timing = FixedCost();
  EXPECT_NEAR(timing.fixed_us(), 4000, 1);
  EXPECT_NEAR(timing.row_us(), 20, 0.1);
}

TEST(BatchTimingTest, AnIdleServerWaitsForNobody) {
  BatchTiming timing = FixedCost();
  timing.NoteRequest(1, 1000);
  EXPECT_EQ(timing.WaitUs(1000), 0) << "a client that was never answered is not due back";
}

TEST(BatchTimingTest, WaitsForThoseJustAnsweredAtMostARoundTrip) {
  BatchTiming timing = FixedCost();
  for (int round = 1; round <= 20; ++round) {  // both come back 500 us after their answers
    timing.NoteAnswered({1, 2}, round * 10'000);
    timing.NoteRequest(1, round * 10'000 + 500);
    timing.NoteRequest(2, round * 10'000 + 500);
  }
  timing.NoteAnswered({1, 2}, 300'000);
  timing.NoteRequest(1, 300'400);
  EXPECT_GT(timing.WaitUs(300'400), 0) << "the other is due";
  EXPECT_LE(timing.WaitUs(300'400), 1000);
  timing.NoteRequest(2, 300'500);
  EXPECT_EQ(timing.WaitUs(300'500), 0) << "all are back";
}

TEST(BatchTimingTest, AClientThatStaysAwayCostsOneWait) {
  BatchTiming timing = FixedCost();
  timing.NoteAnswered({1, 2}, 10'000);
  EXPECT_GT(timing.WaitUs(10'100), 0);
  EXPECT_EQ(timing.WaitUs(20'000), 0) << "late";
  timing.NoteAnswered({1, 2}, 30'000);
  EXPECT_EQ(timing.WaitUs(30'001), 0) << "neither is waited for again";
  timing.NoteRequest(1, 30'200);  // but one comes in time by itself
  timing.NoteAnswered({1}, 40'000);
  EXPECT_GT(timing.WaitUs(40'001), 0);
}

TEST(BatchTimingTest, WaitingNeverCostsMoreThanItCanWin) {
  BatchTiming timing;  // all of a batch's time is its rows': two batches cost no more than one
  for (int i = 0; i < 100; ++i) timing.NoteBatch(1 + i % 16, 500.0 * (1 + i % 16));
  timing.NoteAnswered({1}, 10'000);
  timing.NoteRequest(1, 10'200);
  timing.NoteAnswered({1}, 20'000);
  EXPECT_EQ(timing.WaitUs(20'001), 0);
}

}  // namespace
}  // namespace prospect::services
