#include "services/common/authenticity.h"

#include <openssl/core_names.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/params.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "lcmtypes/checked_codec.h"

namespace prospect::services {
namespace {

constexpr std::size_t kSenderBytes = 4;
constexpr std::size_t kHeaderBytes = kSenderBytes + 8;
static_assert(kTagBytes == kHeaderBytes + KeyedMac::kBytes);

void Append(std::uint64_t number, int count, std::vector<std::uint8_t>* bytes) {
  for (int i = count - 1; i >= 0; --i)
    bytes->push_back(static_cast<std::uint8_t>(number >> (8 * i)));
}

std::uint64_t BigEndian(const std::uint8_t* bytes, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < count; ++i) number = (number << 8) | bytes[i];
  return number;
}

}  // namespace

struct KeyedMac::Context {
  EVP_MAC* algorithm = nullptr;
  EVP_MAC_CTX* state = nullptr;

  ~Context() {
    EVP_MAC_CTX_free(state);
    EVP_MAC_free(algorithm);
  }
};

KeyedMac::KeyedMac(const BusKey& key) : context_(std::make_unique<Context>()) {
  char digest[] = "SHA256";
  const OSSL_PARAM parameters[] = {
      OSSL_PARAM_construct_utf8_string(OSSL_MAC_PARAM_DIGEST, digest, 0),
      OSSL_PARAM_construct_end()};
  context_->algorithm = EVP_MAC_fetch(nullptr, "HMAC", nullptr);
  context_->state = EVP_MAC_CTX_new(context_->algorithm);
  if (!context_->state ||
      EVP_MAC_init(context_->state, key.bytes.data(), key.bytes.size(), parameters) != 1) {
    throw std::runtime_error("OpenSSL gives no HMAC-SHA-256");
  }
}

KeyedMac::~KeyedMac() = default;

void KeyedMac::Compute(const std::string& channel, const std::uint8_t* data, std::size_t size,
                       std::uint8_t* mac) {
  std::uint8_t whole[EVP_MAX_MD_SIZE];
  std::size_t length = 0;
  const auto* name = reinterpret_cast<const std::uint8_t*>(channel.c_str());
  // Without a key, init begins anew with the key that is there.
  if (EVP_MAC_init(context_->state, nullptr, 0, nullptr) != 1 ||
      EVP_MAC_update(context_->state, name, channel.size() + 1) != 1 ||
      EVP_MAC_update(context_->state, data, size) != 1 ||
      EVP_MAC_final(context_->state, whole, &length, sizeof whole) != 1 || length < kBytes) {
    throw std::runtime_error("OpenSSL could not compute an HMAC");
  }
  std::copy_n(whole, kBytes, mac);
}

MessageSigner::MessageSigner(const BusKey& key) : mac_(key), sender_(std::random_device()()) {}

void MessageSigner::Sign(const std::string& channel, std::vector<std::uint8_t>* bytes) {
  bytes->reserve(bytes->size() + kTagBytes);
  Append(sender_, kSenderBytes, bytes);
  Append(++sequence_, 8, bytes);
  const std::size_t covered = bytes->size();
  bytes->resize(covered + KeyedMac::kBytes);
  mac_.Compute(channel, bytes->data(), covered, bytes->data() + covered);
}

bool ReplayWindow::Take(std::uint64_t sequence) {
  if (sequence == 0 || sequence + kWidth <= newest_) return false;
  if (newest_ == 0) {
    taken_.assign(kWidth, true);
    newest_ = sequence;
  } else if (sequence > newest_) {
    const std::uint64_t fresh = std::min(sequence - newest_, kWidth);
    for (std::uint64_t i = 0; i < fresh; ++i) taken_[(sequence - i) % kWidth] = false;
    newest_ = sequence;
  } else if (taken_[sequence % kWidth]) {
    return false;
  }
  taken_[sequence % kWidth] = true;
  return true;
}

const char* MessageVerifier::Verify(const std::string& channel, std::vector<std::uint8_t>* bytes) {
  if (bytes->size() < kTagBytes) return "not authentic";
  const std::size_t covered = bytes->size() - KeyedMac::kBytes;
  std::uint8_t mac[KeyedMac::kBytes];
  mac_.Compute(channel, bytes->data(), covered, mac);
  // In constant time: how long a comparison takes must not tell how much of a forgery was right.
  if (CRYPTO_memcmp(mac, bytes->data() + covered, sizeof mac) != 0) return "not authentic";

  const std::uint8_t* tag = bytes->data() + bytes->size() - kTagBytes;
  const auto sender = static_cast<std::uint32_t>(BigEndian(tag, kSenderBytes));
  const auto [known, added] = senders_.try_emplace(sender);
  if (added) order_.push_back(sender);
  if (!known->second.Take(BigEndian(tag + kSenderBytes, 8))) return "replayed";
  if (order_.size() > kMostSenders) {
    senders_.erase(order_.front());
    order_.pop_front();
  }
  bytes->resize(bytes->size() - kTagBytes);
  return nullptr;
}

std::size_t UntaggedSize(const std::uint8_t* data, std::size_t size) {
  const auto* type = messages::FindByFingerprint(messages::FingerprintOf(data, size));
  if (!type || size <= kTagBytes || !messages::WalkMessage(*type, data, size)) return size;
  return messages::WalkMessage(*type, data, size - kTagBytes) ? size : size - kTagBytes;
}

}  // namespace prospect::services
