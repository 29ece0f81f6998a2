// What services do, and what becomes of their files, does not end the supervisor. The services are
// shell scripts here.

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "services/common/clock.h"
#include "services/supervisor/facts.h"
#include "services/supervisor/supervisor.h"

namespace prospect::services {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Supervising : public testing::Test {
 protected:
  Supervising() {
    std::string name = testing::TempDir() + "supervising_XXXXXX";
    folder = mkdtemp(name.data());
    spec.programs = folder;
    spec.bus = "udpm://x";
    spec.task = "navigation";
    spec.weights = "scripted";
    for (const char* program : {"prospect-model-server", "prospect-simulator", "prospect-worker"}) {
      Program(program, "exec sleep 100");
    }
  }
  ~Supervising() override { fs::remove_all(folder); }

  void Program(const std::string& name, const std::string& text) const {
    const std::string path = folder + "/" + name;
    std::ofstream(path) << "#!/bin/sh\n" << text << '\n';
    chmod(path.c_str(), 0755);
  }

  // Turns until the condition holds, as prospect-supervisor does.
  static bool Until(Supervisor* supervisor, const std::function<bool()>& condition) {
    const std::int64_t end_ms = SteadyMs() + 20000;
    while (!condition()) {
      if (SteadyMs() > end_ms) return false;
      std::vector<pollfd> awaited;
      for (const int output : supervisor->Outputs()) awaited.push_back({output, POLLIN, 0});
      poll(awaited.data(), awaited.size(), 20);
      supervisor->Turn();
    }
    return true;
  }

  // What services.json says of a service.
  json Service(const std::string& name) const {
    std::ifstream in(folder + "/services.json");
    const json file = json::parse(in, nullptr, false);
    if (file.is_discarded()) return nullptr;
    for (const json& service : file.at("services")) {
      if (service.at("name") == name) return service;
    }
    return nullptr;
  }

  std::string folder;
  DeploymentSpec spec;
};

TEST_F(Supervising, LastWordsThatAreNotUtf8AreCleaned) {
  Program("prospect-model-server", "printf 'no caf\\351 here\\n' >&2; exit 10");
  Supervisor supervisor(spec, 1, folder, folder + "/logs");
  ASSERT_TRUE(Until(&supervisor, [&] { return Service("model").at("state") == "given_up"; }));
  EXPECT_EQ(Service("model").at("last_words"), "no caf\xef\xbf\xbd here");
  const auto given_up = ReadGivenUp(folder + "/services.json");
  ASSERT_EQ(given_up.size(), 1u);
  EXPECT_EQ(given_up[0].status, 10);
}

TEST_F(Supervising, WeightsMayHaveANameOfAnOldEncoding) {
  spec.weights = "/caf\xe9/stacking.safetensors";
  Supervisor supervisor(spec, 1, folder, folder + "/logs");
  const auto facts = ReadFacts(folder + "/services.json");
  ASSERT_TRUE(facts.has_value());
  EXPECT_EQ(facts->weights, "/caf\xef\xbf\xbd/stacking.safetensors");
  EXPECT_EQ(facts->workers, 1);
}

TEST_F(Supervising, AFolderOfLogsThatIsRemovedIsMadeAgain) {
  Program("prospect-worker", "while :; do echo alive; sleep 0.1; done");
  Supervisor supervisor(spec, 1, folder, folder + "/logs");
  ASSERT_TRUE(Until(&supervisor, [&] { return fs::file_size(folder + "/logs/worker-1.log") > 0; }));
  fs::remove_all(folder + "/logs");
  kill(Service("model").at("pid"), SIGKILL);
  EXPECT_TRUE(Until(&supervisor, [&] { return Service("model").at("restarts") == 1; }));
  EXPECT_TRUE(Until(&supervisor, [&] { return fs::exists(folder + "/logs/worker-1.log"); }));
}

TEST_F(Supervising, AStateFolderThatIsRemovedEndsNobody) {
  fs::create_directory(folder + "/state");
  Supervisor supervisor(spec, 1, folder + "/state", folder + "/logs");
  fs::remove_all(folder + "/state");
  supervisor.Scale(3);
  EXPECT_NO_THROW(supervisor.Turn());
}

TEST_F(Supervising, AServiceThatPrintsWithoutEndKeepsTwentyMegabytes) {
  Program("prospect-worker", "exec yes it prints and prints");
  Supervisor supervisor(spec, 1, folder, folder + "/logs");
  const std::string log = folder + "/logs/worker-1.log";
  const auto size = [](const std::string& path) {
    std::error_code error;
    const auto bytes = fs::file_size(path, error);
    return error ? 0 : static_cast<std::int64_t>(bytes);
  };
  std::int64_t largest = 0;
  int rotations = 0;
  const auto rotated_twice = [&] {
    static std::int64_t before = 0;
    const std::int64_t now = size(log);
    rotations += now < before ? 1 : 0;
    before = now;
    largest = std::max(largest, now + size(OlderLog(log)));
    return rotations == 2;
  };
  EXPECT_TRUE(Until(&supervisor, rotated_twice));
  EXPECT_LE(largest, 20'000'000);
  const std::int64_t asked_ms = SteadyMs();
  supervisor.Stop();
  EXPECT_LT(SteadyMs() - asked_ms, 4000) << "who prints can still be stopped";
}

TEST_F(Supervising, OldLogsOfMoreWorkersGo) {
  fs::create_directory(folder + "/logs");
  std::ofstream(folder + "/logs/worker-7.log") << "of an earlier deployment";
  std::ofstream(folder + "/logs/logger.log") << "somebody else's";
  Supervisor supervisor(spec, 1, folder, folder + "/logs");
  EXPECT_FALSE(fs::exists(folder + "/logs/worker-7.log"));
  EXPECT_TRUE(fs::exists(folder + "/logs/logger.log"));
}

}  // namespace
}  // namespace prospect::services
