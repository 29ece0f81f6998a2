#include "base/line_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "base/disk_error.h"
#include "tests/unit/base/folder.h"

namespace prospect::base {
namespace {

using LineFile = InFolder;

TEST_F(LineFile, EndsALineThatWasCutShort) {
  std::ofstream(Path("log")) << "whole\nhal";
  AppendLine(Path("log"), "next");
  EXPECT_EQ(Read(Path("log")), "whole\nhal\nnext\n");
}

TEST_F(LineFile, TakesBackWhatDoesNotFit) {
  AppendLine(Path("log"), "first");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {10, 10};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      AppendLine(Path("log"), "more than there is room for");
    } catch (const DiskError&) {
      _exit(7);
    }
    _exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(Read(Path("log")), "first\n");
}

TEST_F(LineFile, LinesOfSeveralProcessesDoNotMix) {
  constexpr int kWriters = 4, kLines = 50;
  const std::string word(5000, 'x');
  for (int i = 0; i < kWriters; ++i) {
    if (fork() != 0) continue;
    for (int k = 0; k < kLines; ++k) AppendLine(Path("log"), word);
    _exit(0);
  }
  while (::wait(nullptr) > 0) {
  }
  std::ifstream file(Path("log"));
  int lines = 0;
  for (std::string line; std::getline(file, line); ++lines) ASSERT_EQ(line, word);
  EXPECT_EQ(lines, kWriters * kLines);
}

}  // namespace
}  // namespace prospect::base
