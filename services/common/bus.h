#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/exit_error.h"
#include "lcmtypes/checked_codec.h"
#include "lcmtypes/validate.h"
#include "services/common/bus_key.h"
#include "services/common/bus_url.h"
#include "services/common/channels.h"
#include "services/common/raw_message.h"
#include "services/common/subscription.h"

namespace prospect::services {

class Chaos;
class MessageSigner;
class MessageVerifier;

/// The bus cannot be opened or subscribed to. The message says what to do; the exit status is
/// kExitBus.
class BusError : public ExitError {
 public:
  explicit BusError(const std::string& message) : ExitError(kExitBus, message) {}
};

/// What became of the messages of one channel since the bus was opened.
struct ChannelCounters {
  std::int64_t received = 0;                    ///< decoded, valid, handed on
  std::map<std::string, std::int64_t> refused;  ///< by reason: "not authentic", "replayed",
                                                ///< "fingerprint", "truncated", "length",
                                                ///< "trailing", "seal", "value ..."
};

/// One LCM connection, made safe. A bus with ttl=0 hears this machine alone (host_filter.h). With a
/// key, what is sent carries a tag and what carries none or a wrong one is refused before anything
/// else looks at it (authenticity.h). Messages are subscribed to raw: LCM's handler only copies the
/// bytes; Poll() then checks the tag, the fingerprint, walks the lengths, decodes, validates and
/// calls the handlers on the caller's thread, with no C frame below. So a handler may throw (Poll
/// passes it on), publish, subscribe, and take its time, though what arrives meanwhile waits in
/// LCM's queue and is dropped beyond the channel's capacity. Nothing unchecked ever reaches a
/// handler; what is refused is counted by channel and reason. A process also hears its own
/// messages.
///
/// Threads: a Bus belongs to one thread, but for Wake() and PublishRaw(), which any thread may
/// call. One Bus a process (two with a bus of its own for inference).
class Bus {
 public:
  /// Opens the bus and proves that it carries: no route or a dead loopback is found out here and
  /// not later.
  /// @param url as ResolveBusUrl takes it; empty for the environment's or the default
  /// @param chaos faults to be suffered, as ParseChaos takes them; empty for the process's own
  /// (SetChaos), which by default are none
  /// @param key of the deployment; null for the process's own (SetProcessBusKey), by default none
  /// @throws BusError saying what to do; std::invalid_argument as ParseChaos does
  explicit Bus(const std::string& url = "", const std::string& chaos = "",
               const BusKey* key = nullptr);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// The URL in use, resolved.
  const std::string& url() const { return url_; }

  /// Whether messages carry tags here and those without are refused.
  bool keyed() const { return verifier_ != nullptr; }

  /// Calls `handler` from Poll() for each valid message of `channel`. The name is taken literally,
  /// not as a regular expression. Several handlers on one channel are called in order of
  /// subscription, until what is returned is destroyed.
  /// @throws BusError when LCM refuses; std::logic_error when the channel was subscribed to with
  /// another type
  template <class T>
  Subscription Subscribe(const std::string& channel, std::function<void(const T&)> handler);

  /// The same on T's own channel.
  template <class T>
  Subscription Subscribe(std::function<void(const T&)> handler) {
    return Subscribe<T>(ChannelOf<T>(), std::move(handler));
  }

  /// Calls `handler` from Poll() for each message on any channel, without its tag and unchecked but
  /// for that, until what is returned is destroyed: for tools that list traffic. @throws BusError;
  /// std::logic_error after a Subscribe()
  Subscription SubscribeAll(std::function<void(const RawMessage&)> handler);

  /// Sends a message. @return false when LCM could not send it (too large, no route any more); true
  /// says nothing about arrival.
  /// @throws messages::EncodeError when a count differs from its array's size: a fault of the
  /// caller
  template <class T>
  bool Publish(const std::string& channel, const T& message) {
    return PublishRaw(channel, messages::CheckedEncode(message));
  }

  /// The same on T's own channel.
  template <class T>
  bool Publish(const T& message) {
    return Publish<T>(ChannelOf<T>(), message);
  }

  /// Sends bytes as they are. Safe from any thread. @return false when LCM could not send them.
  bool PublishRaw(const std::string& channel, const std::vector<std::uint8_t>& bytes);

  /// Waits until a message arrives, Wake() is called, a signal comes or `timeout_ms` passes, then
  /// hands on what has arrived, at most kMaxPerPoll messages. @param timeout_ms 0 does not wait,
  /// negative waits for ever
  /// @return number of messages handed on or refused
  int Poll(int timeout_ms);

  /// Ends a Poll() that waits, or makes the next one return at once: for a thread that has results
  /// for the loop. Safe from any thread.
  void Wake();

  /// Counters by channel, for HEALTH and tests.
  const std::map<std::string, ChannelCounters>& counters() const { return counters_; }
  /// Sum over channels of messages handed on.
  std::int64_t received() const;
  /// Sum over channels and reasons of messages refused.
  std::int64_t refused() const;
  /// Counts a message that the caller's own rules refuse ("unknown action"), so that it shows in
  /// HEALTH like the others.
  void CountRefused(const std::string& channel, const std::string& reason);

  /// What chaos did to this process, by kind; empty without chaos.
  std::map<std::string, std::int64_t> chaos_counters() const;

  /// Bound on the messages that one Poll() hands on, so that a flood cannot keep the loop from its
  /// other duties.
  static constexpr int kMaxPerPoll = 512;

 private:
  // A channel's handlers with their type forgotten: decodes once for all of them.
  struct Hub {
    virtual ~Hub() = default;
    virtual bool empty() const = 0;                           // nobody listens any more
    virtual std::string Take(const RawMessage& message) = 0;  // reason of refusal, or empty
  };
  template <class T>
  struct TypedHub;
  struct Connection;  // LCM itself, out of sight of those who include this header

  void Open(const std::string& channel, int queue_capacity);
  void Listen(int timeout_ms);
  void Dispatch(RawMessage message);

  std::string url_;
  std::unique_ptr<MessageSigner> signer_;      // null: an open bus
  std::unique_ptr<MessageVerifier> verifier_;  // null: an open bus
  std::map<std::string, std::unique_ptr<Hub>> hubs_;
  HandlerList<RawMessage> raw_handlers_;
  bool hears_all_ = false;  // LCM brings every channel
  std::map<std::string, ChannelCounters> counters_;
  std::unique_ptr<Chaos> chaos_;    // null: none
  std::deque<RawMessage> arrived_;  // to be handed on
  std::unique_ptr<Connection> connection_;
};

template <class T>
struct Bus::TypedHub : Bus::Hub {
  HandlerList<T> handlers;

  bool empty() const override { return handlers.empty(); }

  std::string Take(const RawMessage& message) override {
    const messages::DecodeResult<T> result =
        messages::CheckedDecode<T>(message.bytes.data(), message.bytes.size());
    if (!result.ok()) return result.reason;
    const std::string reason = messages::Validate(result.value);
    if (!reason.empty()) return reason;
    handlers.Call(result.value);
    return "";
  }
};

template <class T>
Subscription Bus::Subscribe(const std::string& channel, std::function<void(const T&)> handler) {
  std::unique_ptr<Hub>& hub = hubs_[channel];
  if (!hub) {
    const ChannelInfo* info = FindChannel(channel);
    hub = std::make_unique<TypedHub<T>>();
    Open(channel, info ? info->queue_capacity : 64);
  }
  auto* typed = dynamic_cast<TypedHub<T>*>(hub.get());
  if (!typed) throw std::logic_error("channel " + channel + " carries another message type");
  return typed->handlers.Add(std::move(handler));
}

}  // namespace prospect::services
