// How much memory training takes: as much for many trials as for few, since pictures and encodings
// lie in mapped files, which the system takes back where memory is short.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/training/scores.h"
#include "model/training/trainer.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

constexpr int kFew = 75, kMany = 4 * kFew;

TrainConfig FewSteps() {
  TrainConfig config;
  config.network.image_width = config.network.image_height = 32;
  config.network.num_actions = 3;
  config.network.hidden_channels = 32;  // encodings as large as the pictures
  config.mids_per_segment = 1;
  config.landmark_weight = 1.0;
  config.augment = "dihedral";
  config.hidden_variants = 2;
  for (StageConfig* stage : {&config.classifier, &config.encoder_decoder, &config.transform_hidden,
                             &config.transform_image, &config.heads}) {
    *stage = {3, 2, 1e-3};
  }
  return config;
}

void WriteData(const std::string& path, int trials) {
  std::vector<std::string> parts;
  for (int seed = 0; seed < trials; ++seed) {
    parts.push_back(path + std::to_string(seed));
    WriteTrialFile(parts.back(),
                   MadeTrial(static_cast<std::uint64_t>(seed), 3, seed % 3 == 0, 5, 32));
  }
  PackTrialFiles(parts, path);
  for (const std::string& part : parts) std::filesystem::remove(part);
}

/// Anonymous memory of a process now, in kB: all but mapped files.
long AnonymousKb(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/status");
  std::string line;
  long kb = 0;
  while (std::getline(in, line)) std::sscanf(line.c_str(), "RssAnon: %ld", &kb);
  return kb;
}

/// The most that a child of this process has while it does `work`; -1 if it fails.
long PeakKb(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    // What is freed goes back at once, so that only what is in use is measured.
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_MMAP_THRESHOLD, 256 << 10);
    mallopt(M_TRIM_THRESHOLD, 256 << 10);
    try {
      work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      ::_exit(1);
    }
    ::_exit(0);
  }
  long peak = 0;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    peak = std::max(peak, AnonymousKb(child));
    const timespec pause{0, 2'000'000};
    ::nanosleep(&pause, nullptr);
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? peak : -1;
}

struct Memory {
  long peak_kb = 0;
  long encodings_kb = 0;  // the cache of encodings; that of pictures is as large
};

Memory TrainOn(const TestFolder& folder, int trials) {
  const std::string data = folder / (std::to_string(trials) + ".h5");
  TrainOptions options;
  options.task = "made";
  options.data = data;
  options.folder = data + ".run";
  options.threads = 1;  // how much two hold at once is a matter of chance
  // Written by a process of its own, which leaves nothing in the memory of the next ones.
  EXPECT_GT(PeakKb([&] { WriteData(data, trials); }), 0);
  const long peak = PeakKb([&] {
    Trainer trainer(FewSteps(), options);
    trainer.Run();
    ComputeScores(trainer.context(), trainer.file(), options.threads);
  });
  EXPECT_GT(peak, 10'000);
  for (const auto& entry : std::filesystem::directory_iterator(options.folder + "/cache")) {
    if (entry.path().filename().string().rfind("hidden", 0) == 0)
      return {peak, static_cast<long>(entry.file_size() >> 10)};
  }
  ADD_FAILURE() << "no encodings in " << options.folder;
  return {};
}

// The bound tells a cache that is held in memory, and libhdf5's own if it were not limited.
TEST(TrainingMemory, DoesNotGrowWithTheDataSet) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has memory of its own";
#endif
  const TestFolder folder;
  const Memory few = TrainOn(folder, kFew), many = TrainOn(folder, kMany);
  std::printf("%d trials: %ld kB, %d trials: %ld kB\n", kFew, few.peak_kb, kMany, many.peak_kb);
  const long more_encodings = many.encodings_kb - few.encodings_kb;
  ASSERT_GT(more_encodings, 6000);
  EXPECT_LT(many.peak_kb - few.peak_kb, more_encodings / 2);
}

}  // namespace
}  // namespace prospect::model
