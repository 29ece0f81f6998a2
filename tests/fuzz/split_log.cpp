// split_log LOG FOLDER: real messages out of a recording, as files FOLDER/TYPE/N: for each type the
// first message, and a few more that differ most in size. What record_corpus.sh uses.

#include <lcm/eventlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "lcmtypes/schema.h"
#include "services/common/channels.h"

namespace {

using Bytes = std::vector<std::uint8_t>;
using BySize = std::map<std::size_t, Bytes>;

constexpr std::size_t kKeptBytes = 4096;  // a type, beyond its first message
constexpr std::size_t kMostKept = 6;

// The first message of each size, by type.
std::map<std::string, BySize> Read(lcm_eventlog_t* log) {
  std::map<std::string, BySize> found;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    const auto* data = static_cast<const std::uint8_t*>(event->data);
    const Bytes bytes(data, data + event->datalen);
    const auto* channel = prospect::services::FindChannel(
        {event->channel, static_cast<std::size_t>(event->channellen)});
    if (channel) found[channel->type_name].emplace(bytes.size(), bytes);
    lcm_eventlog_free_event(event);
  }
  return found;
}

// Sizes spread over what there is, small ones first.
std::vector<Bytes> Choose(const BySize& messages) {
  std::vector<const Bytes*> all;
  for (const auto& [size, bytes] : messages) all.push_back(&bytes);
  std::vector<Bytes> chosen;
  std::size_t kept = 0;
  const std::size_t step = std::max<std::size_t>(1, all.size() / kMostKept);
  for (std::size_t i = 0; i < all.size() && chosen.size() < kMostKept; i += step) {
    if (!chosen.empty() && kept + all[i]->size() > kKeptBytes) break;
    kept += all[i]->size();
    chosen.push_back(*all[i]);
  }
  return chosen;
}

void Write(const std::vector<Bytes>& messages, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    std::ofstream file(folder + "/" + std::to_string(i + 1), std::ios::binary);
    file.write(reinterpret_cast<const char*>(messages[i].data()),
               static_cast<std::streamsize>(messages[i].size()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: split_log LOG FOLDER\n");
    return 2;
  }
  lcm_eventlog_t* log = lcm_eventlog_create(argv[1], "r");
  if (!log) {
    std::fprintf(stderr, "cannot read %s\n", argv[1]);
    return 14;
  }
  int missing = 0;
  auto found = Read(log);
  lcm_eventlog_destroy(log);
  for (const auto& channel : prospect::services::Channels()) {
    const auto chosen = Choose(found[channel.type_name]);
    Write(chosen, std::string(argv[2]) + "/" + channel.type_name);
    if (chosen.empty()) std::fprintf(stderr, "no %s in the log\n", channel.type_name), ++missing;
  }
  return missing == 0 ? 0 : 14;
}
