#include "cli/run/deployment.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/run/processes.h"

namespace prospect::cli {
namespace {

constexpr std::chrono::seconds kPatience{60};
constexpr int kNotExecutable = 126, kNotThere = 127;

base::ChildResult Ask(const Words& command) {
  base::ChildOptions options;
  options.command = command;
  return base::RunCaptured(options, kPatience);
}

int StatusOf(const base::ChildResult& result) { return result.status.value_or(kExitTimeout); }

void Require(const base::ChildResult& result) {
  if (StatusOf(result) == kExitSuccess) return;
  throw ExitError(static_cast<ExitCode>(StatusOf(result)), WithoutError(result.err));
}

std::map<std::string, std::string> Facts(const std::string& lines) {
  std::map<std::string, std::string> facts;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find('=');
    if (at != std::string::npos) facts[line.substr(0, at)] = line.substr(at + 1);
  }
  return facts;
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

Words Deployment::Asking(const std::string& command, const Words& arguments) const {
  Words words{PathOf("prospect-supervisor"), command, "--bus", bus_};
  if (!state_.empty()) words.insert(words.end(), {"--state", state_});
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

std::string Deployment::Folder() const {
  const base::ChildResult said = Ask(Asking("folder"));
  cli::Require(said);
  return FirstLine(said.out);
}

std::optional<UpFacts> Deployment::Join(const Words& wishes) const {
  const base::ChildResult said = Ask(Asking("join", wishes));
  const int status = StatusOf(said);
  if (status == kExitServiceLost || status == kNotExecutable || status == kNotThere)
    return std::nullopt;
  cli::Require(said);
  std::map<std::string, std::string> facts = Facts(said.out);
  setenv("PROSPECT_DEPLOYMENT", facts["deployment"].c_str(), 1);
  unsetenv("PROSPECT_KEY_FILE");
  if (!facts["key"].empty()) setenv("PROSPECT_KEY_FILE", facts["key"].c_str(), 1);
  return UpFacts{facts["key"], facts["task"], facts["task_file"], facts["logs"],
                 std::atoi(facts["workers"].c_str())};
}

UpFacts Deployment::Require() const {
  if (const auto facts = Join()) return *facts;
  throw ExitError(kExitServiceLost, "nothing is up on " + bus_ + ": " + Typed("up"));
}

Words Deployment::StartCommand(const Words& arguments) const {
  Words words{PathOf("prospect-supervisor"), "--bus", bus_};
  if (!state_.empty()) words.insert(words.end(), {"--state", state_});
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

void Deployment::Start(const Words& arguments) const {
  Words all{"--background"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  if (const int status = RunToEnd(StartCommand(all)); status != 0) throw Ended{status};
}

int Deployment::Stop(bool silently) const {
  const base::ChildResult said = Ask(Asking("stop"));
  if (!silently) std::fputs(said.err.c_str(), stderr);
  return StatusOf(said);
}

int Deployment::Scale(int workers) const {
  return RunToEnd(Asking("scale", {std::to_string(workers)}));
}

int Deployment::TellGivenUp() const { return RunToEnd(Asking("given-up")); }

int Deployment::Await(const std::string& services) const {
  return RunToEnd(
      {PathOf("prospect-bus"), "wait", "--bus", bus_, "--services", services, "--seconds", "20"});
}

std::string MakePrivateState() {
  const base::ChildResult said = Ask({PathOf("prospect-supervisor"), "folder", "--private"});
  Require(said);
  return FirstLine(said.out);
}

}  // namespace prospect::cli
