#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/common/bus_key.h"

/// Which messages come from somebody who has the deployment's key. A tag of 24 bytes follows the
/// message: sender (4 bytes, random), sequence (8 bytes, grows by one a message), and the first 12
/// bytes of HMAC-SHA-256 (RFC 2104, truncated as RFC 4868 allows) over
///     channel, one zero byte, message, sender, sequence
/// all big-endian. LCM's own tools show a tagged message as they show any other: the decoders that
/// lcm-gen makes stop at the end of the type. HMAC-SHA-256 is in the standard library of every
/// language a robot is written in; docs/security.md has it in Python and Java.
namespace prospect::services {

inline constexpr std::size_t kTagBytes = 24;

/// HMAC-SHA-256 by OpenSSL with one key, prepared once. Not thread-safe.
class KeyedMac {
 public:
  static constexpr std::size_t kBytes = 12;
  explicit KeyedMac(const BusKey& key);
  ~KeyedMac();
  KeyedMac(const KeyedMac&) = delete;
  KeyedMac& operator=(const KeyedMac&) = delete;

  /// Writes kBytes to `mac`: of `channel`, a zero byte, and `size` bytes at `data`.
  void Compute(const std::string& channel, const std::uint8_t* data, std::size_t size,
               std::uint8_t* mac);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Tags what one bus sends. Not thread-safe.
class MessageSigner {
 public:
  explicit MessageSigner(const BusKey& key);
  /// Appends the tag.
  void Sign(const std::string& channel, std::vector<std::uint8_t>* bytes);

 private:
  KeyedMac mac_;
  std::uint32_t sender_;
  std::uint64_t sequence_ = 0;
};

/// Which numbers of a sequence were taken: each once, none from before the first that was heard,
/// and none that is further behind the newest than messages overtake one another on the way.
class ReplayWindow {
 public:
  static constexpr std::uint64_t kWidth = 4096;
  /// @return whether `sequence` is new; it is taken then
  [[nodiscard]] bool Take(std::uint64_t sequence);

 private:
  std::vector<bool> taken_;  // of the kWidth numbers up to newest_, by number modulo kWidth
  std::uint64_t newest_ = 0;
};

/// Checks and removes tags. Remembers every sender that had the key, and only those, so a stranger
/// cannot make it grow; of more than kMostSenders the longest known are forgotten. Not thread-safe.
class MessageVerifier {
 public:
  static constexpr std::size_t kMostSenders = 4096;
  explicit MessageVerifier(const BusKey& key) : mac_(key) {}

  /// Removes the tag of a message that may be believed. @return null, or why it may not be:
  /// "not authentic" (no tag, changed, another channel, another key) or "replayed" (heard before)
  [[nodiscard]] const char* Verify(const std::string& channel, std::vector<std::uint8_t>* bytes);

 private:
  KeyedMac mac_;
  std::unordered_map<std::uint32_t, ReplayWindow> senders_;
  std::deque<std::uint32_t> order_;  // of senders_, the longest known first
};

/// The size of the message at `data` without the tag that may follow it: for readers of recordings,
/// which trust their file and have no key. Bytes that are no message of ours keep their size.
std::size_t UntaggedSize(const std::uint8_t* data, std::size_t size);

}  // namespace prospect::services
