#include "cli/run/executive.h"

#include <algorithm>

#include "cli/commands/executive.h"
#include "cli/options/task.h"
#include "cli/run/processes.h"

namespace prospect::cli {
namespace {

// What the call says instead, and the key, which the environment names.
constexpr const char* kOwn[] = {"--bus", "--key", "--out", "--workers"};

bool IsOwn(const std::string& word) {
  return std::any_of(std::begin(kOwn), std::end(kOwn), [&](const std::string& name) {
    return word == name || word.starts_with(name + "=");
  });
}

}  // namespace

int RunExecutive(const Invocation& invocation, const ExecutiveCall& call) {
  CLI::App executive;
  ExecutiveOptions unused;
  Define(executive, unused);
  Words command{PathOf("prospect-executive"),
                "--bus",
                call.bus,
                "--out",
                call.out,
                "--workers",
                std::to_string(std::max(call.workers, 1))};
  for (const std::string& word : HandedOn(invocation.app, executive))
    if (!IsOwn(word)) command.push_back(word);
  command.insert(command.end(), call.more.begin(), call.more.end());
  return RunToEnd(command);
}

std::string UsualFolder(const std::string& task, std::int64_t seed) {
  return "out/" + TaskOf(task).spec.name + "-" + std::to_string(seed);
}

}  // namespace prospect::cli
