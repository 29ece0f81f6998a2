// The log of a service: bounded, whole, and there again when somebody took it away.

#include "services/supervisor/service_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace prospect::services {
namespace {

namespace fs = std::filesystem;

class ServiceLogs : public testing::Test {
 protected:
  ServiceLogs() {
    std::string name = testing::TempDir() + "log_XXXXXX";
    folder = mkdtemp(name.data());
    path = folder + "/logs/model.log";
  }
  ~ServiceLogs() override { fs::remove_all(folder); }

  static void Print(ServiceLog* log, const std::string& text) {
    ASSERT_EQ(write(log->input(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    log->Drain();
  }

  static std::string Read(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::string folder, path;
};

TEST_F(ServiceLogs, HoldWhatWasPrinted) {
  ServiceLog log(path);
  EXPECT_EQ(log.LastLine(), "");
  Print(&log, "one\ntwo\n\n");
  EXPECT_EQ(Read(path), "one\ntwo\n\n");
  EXPECT_EQ(log.LastLine(), "two");
  Print(&log, "half a li");
  EXPECT_EQ(log.LastLine(), "half a li");
}

TEST_F(ServiceLogs, BeginAnew) {
  fs::create_directories(folder + "/logs");
  std::ofstream(path) << "of an earlier deployment\n";
  const ServiceLog log(path);
  EXPECT_EQ(Read(path), "");
}

TEST_F(ServiceLogs, KeepTheLastTwoFilesOfBoundedSize) {
  constexpr int kMax = 5000;
  ServiceLog log(path, kMax);
  std::string all;
  for (int i = 0; i < 3000; ++i) {
    const std::string line = "line " + std::to_string(i) + "\n";
    all += line;
    Print(&log, line);
  }
  const std::string older = Read(OlderLog(path)), newer = Read(path);
  EXPECT_LE(older.size(), static_cast<std::size_t>(kMax));
  EXPECT_LE(newer.size(), static_cast<std::size_t>(kMax));
  const std::string kept = older + newer;
  EXPECT_GT(kept.size(), static_cast<std::size_t>(kMax));
  EXPECT_EQ(all.substr(all.size() - kept.size()), kept) << "nothing is lost between the two";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder + "/logs"), {}), 2);
}

TEST_F(ServiceLogs, AreThereAgainWhenTheirFolderWasRemoved) {
  ServiceLog log(path);
  Print(&log, "before\n");
  fs::remove_all(folder + "/logs");
  for (int turn = 0; turn < 500 && !fs::exists(path); ++turn) {
    Print(&log, "after\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_NE(Read(path).find("after\n"), std::string::npos);
}

TEST_F(ServiceLogs, ThatCannotBeWrittenAreToldAtTheStartAndBorneLater) {
  std::ofstream(folder + "/file") << "in the way";
  EXPECT_THROW(ServiceLog(folder + "/file/model.log"), std::runtime_error);
  ServiceLog log(path);
  fs::remove_all(folder + "/logs");
  std::ofstream(folder + "/logs") << "in the way";
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // it looks once a second
  Print(&log, "last words\n");
  EXPECT_EQ(log.LastLine(), "last words");
}

}  // namespace
}  // namespace prospect::services
