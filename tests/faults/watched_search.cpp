#include "tests/faults/watched_search.h"

namespace prospect::tests {

WatchedSearch::WatchedSearch(const std::string& name) : folder(MakeFolder(name)) {}

Process WatchedSearch::Program(const std::string& name, const std::vector<std::string>& arguments) {
  return Process(name, arguments, folder + "/" + std::to_string(++started_) + "-" + name + ".log");
}

Process& WatchedSearch::Server() {
  return servers_.emplace_back(
      Program("prospect-model-server", {"--weights", "scripted-tree", "--fixed-cost", "5,0"}));
}

bool WatchedSearch::Up(int servers, int workers) {
  return witness.Until(
      [&] { return witness.Ready("model", servers) && witness.Ready("worker", workers); }, 20000);
}

Process& WatchedSearch::Begin(int workers, int budget_ms) {
  const std::vector<std::string> arguments{
      "--log-level", "off",        "--workers",   std::to_string(workers),
      "--samples",   "1000000000", "--budget-ms", std::to_string(budget_ms)};
  answer_log_ = folder + "/answer.json";
  asker_ = std::make_unique<Process>("tests/fault-asker", arguments, answer_log_);
  return *asker_;
}

bool WatchedSearch::UnderWay() {
  return witness.Until([&] { return observer.rollouts() >= 50; }, 20000);
}

nlohmann::json WatchedSearch::End() {
  int code = -1;
  witness.Until([&] { return (code = asker_->Wait(0)) >= 0; }, 30000);
  return code == 0 ? nlohmann::json::parse(ReadText(answer_log_), nullptr, false)
                   : nlohmann::json();
}

std::int64_t WatchedSearch::IdOf(const std::string& service, int pid) const {
  for (const auto& health : witness.Services(service)) {
    if (health.pid == pid) return health.instance_id;
  }
  return 0;
}

}  // namespace prospect::tests
