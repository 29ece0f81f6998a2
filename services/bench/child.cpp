#include "services/bench/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "services/common/exit_codes.h"
#include "services/common/run_main.h"

namespace prospect::services {
namespace {

std::string Find(const std::string& program) {
  const auto path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  if (!std::filesystem::exists(path)) {
    throw ExitError(kExitServiceLost, "no " + path.string() + ": ./prospect setup builds it");
  }
  return path.string();
}

[[noreturn]] void Become(const std::vector<std::string>& words, const std::string& log) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

Child::Child(const std::string& program, const std::vector<std::string>& arguments,
             const std::string& log) {
  std::vector<std::string> words{Find(program)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  pid_ = fork();
  if (pid_ < 0) throw ExitError(kExitServiceLost, "cannot start another process");
  if (pid_ == 0) Become(words, log);
}

Child::~Child() {
  if (!Running()) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

bool Child::Running() {
  if (pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == pid_) pid_ = -1;
  return pid_ > 0;
}

// Fields 14 and 15 of /proc/PID/stat, counted from behind the name, which may hold spaces.
double Child::CpuSeconds() {
  if (!Running()) return cpu_seconds_;
  std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;
  double user = 0, system = 0;
  if (fields >> user >> system)
    cpu_seconds_ = (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return cpu_seconds_;
}

}  // namespace prospect::services
