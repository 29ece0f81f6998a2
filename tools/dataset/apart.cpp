#include "tools/dataset/apart.h"

#include <cstdio>
#include <cstring>

#include "base/atomic_file.h"
#include "base/child_process.h"
#include "base/run_main.h"

namespace prospect::tools {
namespace {

constexpr char kName[] = "prospect-data";
constexpr int kSignalled = 128;  // and the signal: the status of what one has ended

// What a child that crashed left of the data set it wrote: whoever takes the same name next,
// removes it.
void RemoveHalf(const std::string& out) {
  if (out.empty()) return;
  try {
    const base::AtomicFile abandoned(out);
  } catch (const base::DiskError&) {
    // Then nothing was begun.
  }
}

}  // namespace

int RunApart(const std::function<int()>& work, const std::string& out) {
  const auto guarded = [&work] {
    const int code = RunMain(work, kName, kExitDisk);
    std::fflush(nullptr);
    return code;
  };
  const int status = base::ChildProcess(guarded).Wait();
  if (status <= kSignalled) return status;
  RemoveHalf(out);
  std::fprintf(
      stderr,
      "%s: libhdf5 was stopped by '%s' on a damaged file: leave out files in turn to find it, and "
      "make it anew\n",
      kName, strsignal(status - kSignalled));
  return kExitDataFile;
}

}  // namespace prospect::tools
