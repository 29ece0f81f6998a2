#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/disk_error.h"

namespace prospect::base {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLookAgain{5};
constexpr milliseconds kKernelPatience{2000};  // what was killed is gone sooner, if ever

[[noreturn]] void FailToStart() {
  throw std::runtime_error(std::string("no new process: ") + std::strerror(errno));
}

std::vector<char*> Pointers(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// This process's environment with the changes.
std::vector<std::string> EnvironmentWith(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) all.push_back(text);
  }
  for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
  return all;
}

// In the child: never outlive the parent.
void DieWith(int parent, int death_signal) {
  prctl(PR_SET_PDEATHSIG, death_signal);
  if (getppid() != parent) _exit(1);  // it died before the line above
}

// Runs between fork and exec, where other threads' locks may be held for ever: nothing but calls
// that are safe in a signal handler.
[[noreturn]] void Become(char* const* words, char* const* environment, const ChildOptions& options,
                         int parent) {
  if (options.detached) setsid();
  DieWith(parent, options.death_signal);
  signal(SIGPIPE, SIG_DFL);  // stop_signals.h ignores it
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (options.detached) dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  if (options.out >= 0) dup2(options.out, STDOUT_FILENO);
  if (options.err >= 0) dup2(options.err, STDERR_FILENO);
  execve(words[0], words, environment);
  _exit(127);
}

// A pipe of which children get the writing end only as `out` or `err`.
std::array<Descriptor, 2> Pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) FailToStart();
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

// Takes what is there; closes the pipe at its end. @return whether there was anything
bool Take(Descriptor* pipe, std::string* text) {
  char buffer[65536];
  const ssize_t n = read(pipe->get(), buffer, sizeof buffer);
  if (n == 0 || (n < 0 && errno != EINTR)) pipe->Close();
  if (n > 0) text->append(buffer, static_cast<std::size_t>(n));
  return n > 0;
}

}  // namespace

ChildProcess::ChildProcess(const ChildOptions& options) {
  if (options.command.empty()) throw std::runtime_error("no new process: no program is named");
  const std::vector<std::string> entries = EnvironmentWith(options.environment);
  const std::vector<char*> words = Pointers(options.command), environment = Pointers(entries);
  const int parent = getpid();
  pid_ = fork();
  if (pid_ == 0) Become(words.data(), environment.data(), options, parent);
  if (pid_ < 0) FailToStart();
}

ChildProcess::ChildProcess(const std::function<int()>& body) {
  const int parent = getpid();
  pid_ = fork();
  if (pid_ < 0) FailToStart();
  if (pid_ > 0) return;
  DieWith(parent, SIGKILL);
  _exit(body());
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      status_(other.status_),
      cpu_seconds_(other.cpu_seconds_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);  // the other one ends what this one ran
  std::swap(status_, other.status_);
  std::swap(cpu_seconds_, other.cpu_seconds_);
  return *this;
}

ChildProcess::~ChildProcess() { Kill(); }

bool ChildProcess::Reap(int flags) {
  int status = 0, pid = -1;
  if (pid_ < 0) return false;
  while ((pid = waitpid(pid_, &status, flags)) < 0 && errno == EINTR) {
  }
  if (pid != pid_) return false;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  pid_ = -1;
  return true;
}

bool ChildProcess::Running() {
  Reap(WNOHANG);
  return pid_ >= 0;
}

std::optional<int> ChildProcess::Status() {
  if (Running()) return std::nullopt;
  return status_;
}

int ChildProcess::Wait() {
  Reap(0);
  return status_;
}

std::optional<int> ChildProcess::Wait(Milliseconds longest) {
  const auto deadline = Clock::now() + longest;
  while (Running() && Clock::now() < deadline) std::this_thread::sleep_for(kLookAgain);
  return Status();
}

void ChildProcess::Signal(int number) {
  if (Running()) kill(pid_, number);
}

std::optional<int> ChildProcess::Kill() {
  Signal(SIGKILL);
  return Wait(kKernelPatience);
}

std::optional<int> ChildProcess::End(Milliseconds patience) {
  Signal(SIGTERM);
  const std::optional<int> status = Wait(patience);
  return status ? status : Kill();
}

// Fields 14 and 15 of /proc/PID/stat, counted from behind the name, which may hold spaces.
double ChildProcess::CpuSeconds() {
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

ChildResult RunCaptured(ChildOptions options, milliseconds longest) {
  auto [out, out_end] = Pipe();
  auto [err, err_end] = Pipe();
  options.out = out_end.get();
  options.err = err_end.get();
  const auto deadline = Clock::now() + longest;
  ChildProcess child(options);
  out_end.Close();
  err_end.Close();
  ChildResult result;
  // A grandchild may hold the pipes open: the child's own end is the end, once all is read.
  for (bool more = true; (out || err) && (more || child.Running()) && Clock::now() < deadline;) {
    pollfd ends[] = {{out.get(), POLLIN, 0}, {err.get(), POLLIN, 0}};
    more = poll(ends, 2, static_cast<int>(kLookAgain.count())) > 0;
    if (ends[0].revents != 0) Take(&out, &result.out);
    if (ends[1].revents != 0) Take(&err, &result.err);
  }
  const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
  result.status = child.Wait(std::max(left, milliseconds(0)));
  return result;
}

Descriptor OpenOutput(const std::string& path) {
  Descriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!file) FailToWrite(path, errno);
  return file;
}

std::string ProgramBeside(const std::string& name) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

}  // namespace prospect::base
