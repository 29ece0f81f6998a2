#include "tools/common/fork_map.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/child_process.h"
#include "base/descriptor.h"
#include "base/destination.h"
#include "base/disk_error.h"
#include "base/stop_signals.h"

namespace prospect::tools {
namespace {

using Work = std::function<std::string(int)>;

struct Child {
  base::ChildProcess process;
  base::Descriptor output;
  std::string pending;  // bytes of a line that has not ended yet
  std::string error;    // of the exception that ended it
  bool disk = false;    // it was a base::DiskError
};

// What takes the place of an item's number before the words of an exception, and of a DiskError's,
// which has an exit code of its own.
constexpr int kFailed = -1, kDiskFailed = -2;

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// In a child. @return its exit status
int RunChild(int fd, int first, int items, int jobs, const std::function<Work()>& make_work) {
  signal(SIGINT, SIG_IGN);  // of a terminal, which tells all of its processes: the parent decides
  signal(SIGTERM, SIG_DFL);
  try {
    const Work work = make_work();
    for (int i = first; i < items; i += jobs) {
      if (base::WriteAll(fd, std::to_string(i) + " " + work(i) + "\n") != 0)
        throw std::runtime_error("a worker process could not report its result");
    }
    return 0;
  } catch (const base::DiskError& error) {
    base::WriteAll(fd, std::to_string(kDiskFailed) + " " + OneLine(error.what()) + "\n");
  } catch (const std::exception& error) {
    base::WriteAll(fd, std::to_string(kFailed) + " " + OneLine(error.what()) + "\n");
  }
  return 1;
}

Child StartChild(int first, int items, int jobs, const std::function<Work()>& make_work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  base::Descriptor output(ends[0]);
  const base::Descriptor input(ends[1]);
  base::ChildProcess process([&] {
    output.Close();
    return RunChild(input.get(), first, items, jobs, make_work);
  });
  return {std::move(process), std::move(output), "", "", false};
}

using OnResult = std::function<void(int, const std::string&)>;

// @return how many
int DeliverLines(Child* child, const OnResult& on_result) {
  int delivered = 0;
  std::size_t end;
  while ((end = child->pending.find('\n')) != std::string::npos) {
    const std::string line = child->pending.substr(0, end);
    child->pending.erase(0, end + 1);
    const std::size_t space = line.find(' ');
    const int item = std::stoi(line.substr(0, space));
    if (item < 0) {
      child->error = line.substr(space + 1);
      child->disk = item == kDiskFailed;
    } else {
      on_result(item, line.substr(space + 1));
      ++delivered;
    }
  }
  return delivered;
}

// Reads what is there; false at the end of the child's output.
bool ReadSome(Child* child) {
  char buffer[65536];
  ssize_t n;
  while ((n = read(child->output.get(), buffer, sizeof buffer)) < 0 && errno == EINTR) {
  }
  if (n <= 0) return false;
  child->pending.append(buffer, static_cast<std::size_t>(n));
  return true;
}

// Of children that have closed their ends. After a stop nothing is wrong with those that were
// killed.
void Reap(std::vector<Child>* children, bool stopped) {
  constexpr std::chrono::seconds kLongestEnd{10};
  bool failed = false, disk = false;
  std::string error;
  for (Child& child : *children) {
    failed = failed || child.process.Wait(kLongestEnd) != 0;
    if (error.empty()) error = child.error, disk = child.disk;
  }
  if (!failed || stopped) return;
  if (error.empty()) error = "a worker process ended before its work was done";
  if (disk) throw base::DiskError(error);
  throw std::runtime_error(error);
}

int RunHere(int items, const std::function<Work()>& make_work, const OnResult& on_result) {
  const Work work = make_work();
  int done = 0;
  for (; done < items && !base::StopRequested(); ++done) on_result(done, work(done));
  return done;
}

void KillAll(std::vector<Child>* children) {
  for (Child& child : *children) child.process.Signal(SIGKILL);
}

// Until all have ended. @return items done
int Listen(std::vector<Child>* children, const OnResult& on_result) {
  constexpr int kLookAgainMs = 200;  // for a signal that came just before poll
  int done = 0;
  bool killed = false;
  std::vector<pollfd> open;
  for (const Child& child : *children) open.push_back({child.output.get(), POLLIN, 0});
  for (std::size_t ended = 0; ended < children->size();) {
    if (base::StopRequested() && !killed) {
      KillAll(children);
      killed = true;
    }
    if (poll(open.data(), open.size(), kLookAgainMs) <= 0) continue;
    for (std::size_t j = 0; j < children->size(); ++j) {
      if (open[j].fd < 0 || open[j].revents == 0) continue;
      Child& child = (*children)[j];
      if (ReadSome(&child)) {
        done += DeliverLines(&child, on_result);
      } else {
        child.output.Close();
        open[j].fd = -1;  // poll skips negative descriptors
        ++ended;
      }
    }
  }
  return done;
}

}  // namespace

Extent ForkMap(int items, int jobs, const std::function<Work()>& make_work,
               const OnResult& on_result) {
  base::InstallStopSignals();
  if (jobs <= 1) return {RunHere(items, make_work, on_result), items};
  std::vector<Child> children;
  for (int j = 0; j < jobs; ++j) children.push_back(StartChild(j, items, jobs, make_work));
  const int done = Listen(&children, on_result);
  Reap(&children, base::StopRequested() && done < items);
  return {done, items};
}

}  // namespace prospect::tools
