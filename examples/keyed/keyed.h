#pragma once

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <sys/stat.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

/// A deployment's key for a robot in C++: this file and OpenSSL (libssl-dev) are all it takes. What
/// a tag is: docs/security.md. Not thread-safe.
class Keyed {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @param key_file 64 hexadecimal digits, as ./prospect up made it. @throws std::runtime_error
  explicit Keyed(const std::string& key_file) {
    std::string digits;
    struct stat status {};
    if (stat(key_file.c_str(), &status) == 0 && (status.st_mode & 077) != 0)
      throw std::runtime_error(key_file + " is open to other users: chmod 600");
    std::ifstream(key_file) >> digits;
    if (digits.size() != 64) throw std::runtime_error(key_file + " is no key");
    for (int i = 0; i < 64; i += 2)
      key_.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    const std::uint32_t sender = std::random_device()();
    for (int shift = 24; shift >= 0; shift -= 8) sender_.push_back(Byte(sender, shift));
  }

  /// The message with its tag, to be published on that channel.
  Bytes Sign(const std::string& channel, Bytes message) {
    message.insert(message.end(), sender_.begin(), sender_.end());
    ++sequence_;
    for (int shift = 56; shift >= 0; shift -= 8) message.push_back(Byte(sequence_, shift));
    const Bytes mac = Mac(channel, message);
    message.insert(message.end(), mac.begin(), mac.end());
    return message;
  }

  /// Takes the tag off a message heard on that channel. @return false for one to be refused
  bool Verify(const std::string& channel, Bytes* tagged) {
    if (tagged->size() < kTag) return false;
    const Bytes covered(tagged->begin(), tagged->end() - kMac);
    if (CRYPTO_memcmp(Mac(channel, covered).data(), tagged->data() + covered.size(), kMac) != 0)
      return false;
    std::uint64_t number = 0;
    for (auto byte = covered.end() - 8; byte != covered.end(); ++byte) number = number << 8 | *byte;
    tagged->resize(tagged->size() - kTag);
    return IsNew(Bytes(covered.end() - 12, covered.end() - 8), number);
  }

 private:
  static constexpr int kMac = 12, kTag = 24;
  static constexpr std::uint64_t kWindow = 4096;  // how far messages may overtake one another

  static std::uint8_t Byte(std::uint64_t number, int shift) {
    return static_cast<std::uint8_t>(number >> shift);
  }

  Bytes Mac(const std::string& channel, const Bytes& covered) const {
    Bytes data(channel.c_str(), channel.c_str() + channel.size() + 1);
    data.insert(data.end(), covered.begin(), covered.end());
    Bytes mac(EVP_MAX_MD_SIZE);
    HMAC(EVP_sha256(), key_.data(), static_cast<int>(key_.size()), data.data(), data.size(),
         mac.data(), nullptr);
    mac.resize(kMac);
    return mac;
  }

  bool IsNew(const Bytes& sender, std::uint64_t number) {
    auto& taken = taken_[sender];
    // None from before the first that was heard, none twice, and none that is long past.
    if (!taken.empty() && (number < *taken.begin() || !taken.insert(number).second)) return false;
    taken.insert(number);
    while (*taken.rbegin() - *taken.begin() >= kWindow) taken.erase(taken.begin());
    return true;
  }

  Bytes key_, sender_;
  std::uint64_t sequence_ = 0;
  std::map<Bytes, std::set<std::uint64_t>> taken_;  // by sender
};
