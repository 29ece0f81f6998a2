#include "sim/oracle_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/sim/scripted_task.h"

namespace prospect::sim {
namespace {

class OracleCacheTest : public testing::Test {
 protected:
  OracleCacheTest()
      : folder_(testing::TempDir() + "prospect_oracle_" + std::to_string(getpid())),
        task_(
            [](const std::vector<int>& path, std::uint64_t) { return path[0] == 1 ? "no" : ""; }) {}
  ~OracleCacheTest() override { std::filesystem::remove_all(folder_); }

  OracleKey key_{"scripted", "world-1", 4, 3};
  std::string folder_;
  ScriptedTask task_;
};

TEST_F(OracleCacheTest, KeepsWholeResultsAcrossProcesses) {
  OracleResult stored;
  {
    OracleCache cache(key_, folder_);
    stored = ConsultOracleCached(task_, 17, cache);
  }
  const OracleCache cache(key_, folder_);
  const std::optional<OracleResult> found = cache.Find(17);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->scene_class, stored.scene_class);
  EXPECT_EQ(found->best_plan, stored.best_plan);
  EXPECT_EQ(found->best_successes, stored.best_successes);
  EXPECT_EQ(found->failures, stored.failures);
  ASSERT_EQ(found->plans.size(), stored.plans.size());
  for (std::size_t i = 0; i < stored.plans.size(); ++i) {
    EXPECT_EQ(found->plans[i].plan, stored.plans[i].plan);
    EXPECT_EQ(found->plans[i].successes, stored.plans[i].successes);
  }
  EXPECT_FALSE(cache.Find(18).has_value());
}

TEST_F(OracleCacheTest, KnowsWhatComesWithProspectAndWritesOnlyItsOwn) {
  const std::string bundled = folder_ + "/bundled", own = folder_ + "/own";
  {
    OracleCache first(key_, bundled);
    ConsultOracleCached(task_, 17, first);
  }
  OracleCache cache(key_, own, bundled);
  EXPECT_TRUE(cache.Find(17).has_value());
  ConsultOracleCached(task_, 18, cache);
  EXPECT_FALSE(OracleCache(key_, bundled).Find(18).has_value());
  EXPECT_FALSE(OracleCache(key_, own).Find(17).has_value()) << "it is not copied";
  EXPECT_FALSE(OracleCache({"scripted", "world-2", 4, 3}, own, bundled).Find(17).has_value())
      << "another world";
}

TEST_F(OracleCacheTest, KeepsActionsOfALargeTable) {
  OracleResult stored;
  stored.scene_class = SceneClass::kSolvable;
  for (int action = 0; action < 40; ++action)
    stored.plans.push_back({{action, 39 - action}, action});
  stored.best_plan = {10, 20, 30};  // the tenth digit is the mark before the count
  OracleCache(key_, folder_).Store(17, stored);
  const std::optional<OracleResult> found = OracleCache(key_, folder_).Find(17);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->best_plan, stored.best_plan);
  ASSERT_EQ(found->plans.size(), stored.plans.size());
  for (std::size_t i = 0; i < stored.plans.size(); ++i) {
    EXPECT_EQ(found->plans[i].plan, stored.plans[i].plan);
    EXPECT_EQ(found->plans[i].successes, stored.plans[i].successes);
  }
}

TEST_F(OracleCacheTest, AsksTheOracleOnce) {
  OracleCache cache(key_, folder_);
  ConsultOracleCached(task_, 17, cache);
  const int starts = task_.starts;
  ConsultOracleCached(task_, 17, cache);
  EXPECT_EQ(task_.starts, starts);
}

TEST_F(OracleCacheTest, WorldsAndScenesDoNotMix) {
  OracleCache cache(key_, folder_);
  ConsultOracleCached(task_, 17, cache);
  for (const OracleKey& other :
       {OracleKey{"scripted", "world-2", 4, 3}, OracleKey{"scripted", "world-1", 5, 3},
        OracleKey{"scripted", "world-1", 4, 4},
        OracleKey{"scripted", "world-1", 4, 3, "on(red,*), visited(barrel)"}}) {
    EXPECT_FALSE(OracleCache(other, folder_).Find(17).has_value());
  }
}

TEST_F(OracleCacheTest, SkipsALineThatWasCutShort) {
  std::string path;
  {
    OracleCache cache(key_, folder_);
    ConsultOracleCached(task_, 17, cache);
    path = cache.path();
  }
  std::ofstream(path, std::ios::app) << "{\"seed\": 18, \"cla\n";
  OracleCache cache(key_, folder_);
  EXPECT_TRUE(cache.Find(17).has_value());
  EXPECT_FALSE(cache.Find(18).has_value());
}

TEST_F(OracleCacheTest, SaysWhatToDoWithoutAFolder) {
  try {
    OracleCache cache(key_, "/proc/no/such/folder");
    FAIL() << "made a cache where nothing can be written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("PROSPECT_DATA"), std::string::npos);
  }
}

}  // namespace
}  // namespace prospect::sim
