#include "services/common/bus.h"

#include <fcntl.h>
#include <lcm/lcm.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cctype>
#include <deque>
#include <iterator>
#include <mutex>
#include <utility>

#include "services/common/authenticity.h"
#include "services/common/chaos.h"
#include "services/common/clock.h"
#include "services/common/host_filter.h"

namespace prospect::services {
namespace {

// lcm_subscribe takes a regular expression; our names are meant as they stand.
std::string Quote(const std::string& channel) {
  std::string pattern;
  for (const char c : channel) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') pattern += '\\';
    pattern += c;
  }
  return pattern;
}

// LCM tells stderr in its own words what it finds wrong with an address, before our one line says
// what to do: while one lives, these go nowhere. Only for the moment of opening a bus.
class HushedStderr {
 public:
  HushedStderr() : stderr_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (stderr_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~HushedStderr() {
    if (stderr_ < 0) return;
    dup2(stderr_, STDERR_FILENO);
    close(stderr_);
  }
  HushedStderr(const HushedStderr&) = delete;
  HushedStderr& operator=(const HushedStderr&) = delete;

 private:
  int stderr_;
};

std::unique_ptr<Chaos> MakeChaos(const std::string& text) {
  auto rules = ParseChaos(text);
  if (rules.empty()) return nullptr;
  for (const auto& rule : rules) spdlog::warn("chaos on what is heard here: {}", rule.text);
  return std::make_unique<Chaos>(std::move(rules));
}

}  // namespace

struct Bus::Connection {
  lcm_t* lcm = nullptr;
  int wake_fd = -1;
  // LCM's tcpq provider mixes up what two threads send at once; and signing counts.
  std::mutex sending;
  std::vector<RawMessage> arrived;
  bool out_of_memory = false;

  ~Connection() {
    if (lcm) lcm_destroy(lcm);
    if (wake_fd >= 0) close(wake_fd);
  }

  // Called by LCM from inside lcm_handle: copies, enqueues, returns. No exception may pass through
  // LCM's C frames, and a copy can only fail for want of memory, which is told once we are out of
  // them.
  static void OnMessage(const lcm_recv_buf_t* buffer, const char* channel, void* self) noexcept {
    auto* connection = static_cast<Connection*>(self);
    try {
      const auto* data = static_cast<const std::uint8_t*>(buffer->data);
      connection->arrived.push_back(
          {channel, buffer->recv_utime, {data, data + buffer->data_size}, nullptr});
    } catch (const std::exception&) {
      connection->out_of_memory = true;
    }
  }

  // The pattern is anchored by LCM itself.
  bool Subscribe(const std::string& pattern, int queue_capacity) {
    lcm_subscription_t* subscription = lcm_subscribe(lcm, pattern.c_str(), OnMessage, this);
    if (!subscription) return false;
    lcm_subscription_set_queue_capacity(subscription, queue_capacity);
    return true;
  }

  // Waits for LCM, a Wake() or a signal.
  void Wait(int timeout_ms) {
    pollfd files[2] = {{lcm_get_fileno(lcm), POLLIN, 0}, {wake_fd, POLLIN, 0}};
    poll(files, 2, timeout_ms);
    std::uint64_t wakes = 0;
    [[maybe_unused]] const ssize_t got = read(wake_fd, &wakes, sizeof wakes);
  }

  // LCM opens and tests its sockets only at the first subscription; a channel of ours that nobody
  // uses makes it do so now, so that the filter is there before anything is listened to. A relay
  // that does not answer leaves LCM without a socket.
  bool Opened(const std::string& url) {
    const HushedStderr hushed;
    const HostFilter filter(url);
    lcm = lcm_create(url.c_str());
    if (lcm && Subscribe("PROSPECT_SELF_TEST", 1) && HasSocket() && filter.InForce()) return true;
    if (lcm) lcm_destroy(std::exchange(lcm, nullptr));
    return false;
  }

  // Not so while the relay of a tcpq bus is away: LCM connects again with the next message sent,
  // and must not be asked for arrivals before (it aborts the process).
  bool HasSocket() const { return lcm_get_fileno(lcm) >= 0; }

  // Takes what LCM holds, without waiting.
  void Drain() {
    while (static_cast<int>(arrived.size()) < kMaxPerPoll && HasSocket() &&
           lcm_handle_timeout(lcm, 0) > 0) {
    }
    if (out_of_memory) throw std::bad_alloc();
  }
};

Bus::Bus(const std::string& url, const std::string& chaos, const BusKey* key)
    : url_(ResolveBusUrl(url)),
      chaos_(MakeChaos(chaos.empty() ? ChaosText() : chaos)),
      connection_(std::make_unique<Connection>()) {
  if (!key) key = ProcessBusKey();
  if (key) {
    signer_ = std::make_unique<MessageSigner>(*key);
    verifier_ = std::make_unique<MessageVerifier>(*key);
  }
  connection_->wake_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (!connection_->Opened(url_)) throw BusError(BusAdvice(url_));
  const std::string warning = ReceiveBufferWarning(url_);
  if (!warning.empty()) spdlog::warn("{}", warning);
}

Bus::~Bus() = default;

void Bus::Open(const std::string& channel, int queue_capacity) {
  if (!connection_->Subscribe(Quote(channel), queue_capacity)) {
    throw BusError("cannot subscribe to " + channel + ": " + BusAdvice(url_));
  }
}

Subscription Bus::SubscribeAll(std::function<void(const RawMessage&)> handler) {
  constexpr int kEverything = 8192;
  // One pattern for all channels: it also brings those of Subscribe(), so a tool uses one or the
  // other.
  if (!hubs_.empty())
    throw std::logic_error("SubscribeAll() and Subscribe() exclude each other on one Bus");
  if (!hears_all_ && !connection_->Subscribe(".*", kEverything)) throw BusError(BusAdvice(url_));
  hears_all_ = true;
  return raw_handlers_.Add(std::move(handler));
}

bool Bus::PublishRaw(const std::string& channel, const std::vector<std::uint8_t>& bytes) {
  const auto send = [&](const std::vector<std::uint8_t>& all) {
    return lcm_publish(connection_->lcm, channel.c_str(), all.data(),
                       static_cast<unsigned>(all.size())) == 0;
  };
  const std::lock_guard<std::mutex> lock(connection_->sending);
  if (!signer_) return send(bytes);
  std::vector<std::uint8_t> tagged = bytes;
  signer_->Sign(channel, &tagged);
  return send(tagged);
}

// Waits for messages and takes them over; with chaos, those whose time has come.
void Bus::Listen(int timeout_ms) {
  auto& fresh = connection_->arrived;
  connection_->Wait(chaos_ ? static_cast<int>(chaos_->Remaining(SteadyMs(), timeout_ms))
                           : timeout_ms);
  connection_->Drain();
  std::vector<RawMessage> taken;
  taken.swap(fresh);
  if (chaos_) {
    for (auto& message : taken) chaos_->Take(std::move(message), SteadyMs());
    taken = chaos_->Release(SteadyMs());
  }
  std::move(taken.begin(), taken.end(), std::back_inserter(arrived_));
}

int Bus::Poll(int timeout_ms) {
  // What an earlier Poll() left (a handler threw) goes first and does not wait.
  if (arrived_.size() < kMaxPerPoll) Listen(arrived_.empty() ? timeout_ms : 0);
  int taken = 0;
  while (!arrived_.empty() && taken < kMaxPerPoll) {
    RawMessage message = std::move(arrived_.front());
    arrived_.pop_front();
    ++taken;
    Dispatch(std::move(message));
  }
  return taken;
}

void Bus::Dispatch(RawMessage message) {
  const auto found = hubs_.find(message.channel);
  Hub* hub = found == hubs_.end() || found->second->empty() ? nullptr : found->second.get();
  if (!hub && raw_handlers_.empty()) return;
  if (verifier_) message.refused = verifier_->Verify(message.channel, &message.bytes);
  raw_handlers_.Call(message);
  if (!hub) return;
  // Counted before the handlers run, so that the count holds even if one throws.
  ChannelCounters& counters = counters_[message.channel];
  if (message.refused) {
    ++counters.refused[message.refused];
    return;
  }
  ++counters.received;
  const std::string reason = hub->Take(message);
  if (reason.empty()) return;
  --counters.received;
  ++counters.refused[reason];
}

void Bus::Wake() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(connection_->wake_fd, &one, sizeof one);
}

std::int64_t Bus::received() const {
  std::int64_t sum = 0;
  for (const auto& [channel, counters] : counters_) sum += counters.received;
  return sum;
}

std::int64_t Bus::refused() const {
  std::int64_t sum = 0;
  for (const auto& [channel, counters] : counters_) {
    for (const auto& [reason, count] : counters.refused) sum += count;
  }
  return sum;
}

std::map<std::string, std::int64_t> Bus::chaos_counters() const {
  return chaos_ ? chaos_->counters() : std::map<std::string, std::int64_t>{};
}

void Bus::CountRefused(const std::string& channel, const std::string& reason) {
  ++counters_[channel].refused[reason];
}

}  // namespace prospect::services
