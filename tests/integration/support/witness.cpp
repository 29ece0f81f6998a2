#include "tests/integration/support/witness.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace prospect::tests {

template <class T>
void Witness::Keep(std::vector<T>* list) {
  subscriptions_.push_back(
      bus.Subscribe<T>([list](const T& message) { list->push_back(message); }));
}

Witness::Witness() {
  Keep(&commands);
  Keep(&statuses);
  Keep(&plans);
  Keep(&roots);
  Keep(&stops);
  Keep(&replies);
  subscriptions_.push_back(bus.Subscribe<label_t>([this](const label_t& label) {
    if (label.episode_id != episode_id) labels.clear();
    episode_id = label.episode_id;
    labels[label.frame] = label;
  }));
  subscriptions_.push_back(bus.Subscribe<health_t>(
      [this](const health_t& message) { health[message.instance_id] = message; }));
  subscriptions_.push_back(
      bus.Subscribe<search_statistics_t>([this](const search_statistics_t& rows) {
        if (rows.is_final) finals[rows.writer] = rows.digest;
      }));
}

bool Witness::Until(const std::function<bool()>& condition, int timeout_ms,
                    const std::function<void()>& repeat) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout_ms);
  auto next = std::chrono::steady_clock::now();
  while (!condition()) {
    const auto now = std::chrono::steady_clock::now();
    if (now > deadline) return false;
    if (repeat && now >= next) {
      repeat();
      next = now + std::chrono::milliseconds(20);
    }
    bus.Poll(5);
  }
  return true;
}

void Witness::Listen(int milliseconds) {
  Until([] { return false; }, milliseconds);
}

std::vector<health_t> Witness::Services(const std::string& service) const {
  std::vector<health_t> found;
  for (const auto& [id, message] : health) {
    if (message.service == service && message.state != health_t::STATE_DRAINING)
      found.push_back(message);
  }
  return found;
}

bool Witness::Ready(const std::string& service, int count) const {
  return static_cast<int>(Services(service).size()) >= count;
}

std::string MakeFolder(const std::string& name) {
  const std::string folder = std::string(PROSPECT_TEST_OUT) + "/" + name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string ReadText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace prospect::tests
