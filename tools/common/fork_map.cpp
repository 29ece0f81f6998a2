#include "tools/common/fork_map.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <vector>

namespace prospect::tools {
namespace {

using Work = std::function<std::string(int)>;

struct Child {
  pid_t pid = -1;
  int fd = -1;
  std::string pending;  // bytes of a line that has not ended yet
  std::string error;    // of the exception that ended it
};

void WriteAll(int fd, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = write(fd, text.data() + done, text.size() - done);
    if (n < 0) throw std::runtime_error("a worker process could not report its result");
    done += static_cast<std::size_t>(n);
  }
}

// What takes the place of an item's number before the words of an exception.
constexpr int kFailed = -1;

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// Never returns: a child must not run the parent's destructors or flush its buffers.
[[noreturn]] void RunChild(int fd, int first, int items, int jobs,
                           const std::function<Work()>& make_work) {
  try {
    const Work work = make_work();
    for (int i = first; i < items; i += jobs) {
      WriteAll(fd, std::to_string(i) + " " + work(i) + "\n");
    }
    _exit(0);
  } catch (const std::exception& error) {
    const std::string words = std::to_string(kFailed) + " " + OneLine(error.what()) + "\n";
    [[maybe_unused]] const ssize_t told = write(fd, words.data(), words.size());
  }
  _exit(1);
}

Child StartChild(int first, int items, int jobs, const std::function<Work()>& make_work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (pid == 0) {
    close(ends[0]);
    RunChild(ends[1], first, items, jobs, make_work);
  }
  close(ends[1]);
  return {pid, ends[0], "", ""};
}

void DeliverLines(Child* child, const std::function<void(int, const std::string&)>& on_result) {
  std::size_t end;
  while ((end = child->pending.find('\n')) != std::string::npos) {
    const std::string line = child->pending.substr(0, end);
    child->pending.erase(0, end + 1);
    const std::size_t space = line.find(' ');
    const int item = std::stoi(line.substr(0, space));
    if (item == kFailed) {
      child->error = line.substr(space + 1);
    } else {
      on_result(item, line.substr(space + 1));
    }
  }
}

// Reads what is there; false at the end of the child's output.
bool ReadSome(Child* child) {
  char buffer[65536];
  const ssize_t n = read(child->fd, buffer, sizeof buffer);
  if (n <= 0) return false;
  child->pending.append(buffer, static_cast<std::size_t>(n));
  return true;
}

void Reap(const std::vector<Child>& children) {
  bool failed = false;
  std::string error;
  for (const Child& child : children) {
    int status = 0;
    waitpid(child.pid, &status, 0);
    failed = failed || !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    if (error.empty()) error = child.error;
  }
  if (!failed) return;
  if (error.empty()) error = "a worker process ended before its work was done";
  throw std::runtime_error(error);
}

}  // namespace

void ForkMap(int items, int jobs, const std::function<Work()>& make_work,
             const std::function<void(int, const std::string&)>& on_result) {
  if (jobs <= 1) {
    const Work work = make_work();
    for (int i = 0; i < items; ++i) on_result(i, work(i));
    return;
  }
  std::vector<Child> children;
  for (int j = 0; j < jobs; ++j) children.push_back(StartChild(j, items, jobs, make_work));
  std::vector<pollfd> open;
  for (const Child& child : children) open.push_back({child.fd, POLLIN, 0});
  std::size_t ended = 0;
  while (ended < children.size()) {
    poll(open.data(), open.size(), -1);
    for (std::size_t j = 0; j < children.size(); ++j) {
      if (open[j].fd < 0 || open[j].revents == 0) continue;
      if (ReadSome(&children[j])) {
        DeliverLines(&children[j], on_result);
      } else {
        close(open[j].fd);
        open[j].fd = -1;  // poll skips negative descriptors
        ++ended;
      }
    }
  }
  Reap(children);
}

}  // namespace prospect::tools
