#include "services/console/episode_starter.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "base/exit_error.h"
#include "cli/installation.h"
#include "planner/goal.h"

namespace prospect::services::console {
namespace {

using nlohmann::json;

constexpr std::size_t kMostGoal = 1000;

// `prospect` itself: beside the programs in a build tree, in bin/ where it is installed.
std::string ProspectPath() {
  const std::string folder = cli::ProgramsFolder();
  return cli::IsInstalled() ? folder + "/../../bin/prospect" : folder + "/prospect";
}

std::int64_t Whole(const json& request, const char* name, std::int64_t least, std::int64_t most) {
  const json& value = request.at(name);
  if (!value.is_number_integer() || value.get<std::int64_t>() < least ||
      value.get<std::int64_t>() > most) {
    throw std::invalid_argument(std::string(name) + " is from " + std::to_string(least) + " to " +
                                std::to_string(most));
  }
  return value.get<std::int64_t>();
}

std::string LastLine(const base::Descriptor& file) {
  std::string text(4096, '\0');
  const off_t size = lseek(file.get(), 0, SEEK_END);
  const off_t from =
      size > static_cast<off_t>(text.size()) ? size - static_cast<off_t>(text.size()) : 0;
  const ssize_t got = pread(file.get(), text.data(), text.size(), from);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

std::vector<std::string> RunArguments(const json& request) {
  std::vector<std::string> words{
      "--seed",    std::to_string(Whole(request, "seed", 0, 2'147'483'647)),
      "--samples", std::to_string(Whole(request, "samples", 1, 1'000'000)),
      "--retries", std::to_string(Whole(request, "retries", 0, 32))};
  const std::string goal = request.value("goal", "");
  if (goal.size() > kMostGoal) throw std::invalid_argument("the goal is too long");
  if (!goal.empty()) {
    planner::ParseGoal(goal);  // throws, with words for a person
    words.push_back("--goal=" + goal);
  }
  if (request.contains("threshold") && !request["threshold"].is_null()) {
    const double threshold = request["threshold"].get<double>();
    if (!(threshold >= 0 && threshold <= 1))
      throw std::invalid_argument("the threshold is from 0 to 1");
    words.insert(words.end(), {"--refusal-threshold", std::to_string(threshold)});
  }
  if (!request.value("reset", true)) words.push_back("--no-reset");
  return words;
}

EpisodeStarter::Job EpisodeStarter::Start(const std::vector<std::string>& command) {
  base::Descriptor said(memfd_create("said", MFD_CLOEXEC));
  if (!said) throw std::runtime_error("no memory for what a program says");
  base::ChildOptions options;
  options.command = command;
  options.out = options.err = said.get();
  options.detached = true;
  options.death_signal = SIGTERM;  // so that a robot stands still first
  return {base::ChildProcess(options), std::move(said), std::nullopt, ""};
}

void EpisodeStarter::Look(Job* job) {
  if (job->exit) return;
  job->exit = job->child.Status();
  if (job->exit) job->words = LastLine(job->said);
}

std::string EpisodeStarter::Run(const json& request, const std::string& task) {
  if (running()) return "an episode runs already";
  std::vector<std::string> command{ProspectPath(), "run", "--bus", bus_};
  const std::vector<std::string> words = RunArguments(request);
  seed_ = request.at("seed").get<std::int64_t>();
  folder_ = out_ + "/" + task + "-" + std::to_string(seed_);
  command.insert(command.end(), words.begin(), words.end());
  command.insert(command.end(), {"--out", folder_});
  run_.emplace(Start(command));
  return "";
}

void EpisodeStarter::Stop() {
  if (!running() || run_->asked_to_stop) return;
  run_->asked_to_stop = true;
  run_->child.Signal(SIGTERM);
}

std::string EpisodeStarter::Scale(int workers) {
  if (workers < 0 || workers > 1024) return "workers are from 0 to 1024";
  if (scaling()) return "the number of workers is being changed already";
  scale_.emplace(
      Start({ProspectPath(), "scale", "workers=" + std::to_string(workers), "--bus", bus_}));
  return "";
}

json EpisodeStarter::Facts() {
  json facts = json::object();
  if (scale_) {
    Look(&*scale_);
    facts["scale"] = {
        {"running", !scale_->exit}, {"exit", scale_->exit.value_or(-1)}, {"words", scale_->words}};
  }
  if (run_) {
    Look(&*run_);
    facts["run"] = {{"running", !run_->exit},
                    {"seed", seed_},
                    {"out", folder_},
                    {"exit", run_->exit.value_or(-1)},
                    {"words", run_->words}};
  }
  return facts;
}

}  // namespace prospect::services::console
