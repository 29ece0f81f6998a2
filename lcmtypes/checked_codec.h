#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "lcmtypes/counts.h"
#include "lcmtypes/fields.h"
#include "lcmtypes/schema.h"

/// The only way bytes become messages here, and back. LCM 1.3.1's generated decoders trust what
/// they read: a negative count throws, a huge one allocates gigabytes first; its encoders read past
/// a vector that is shorter than its count. So bytes are walked by the schema before the generated
/// decoder sees them, and counts are compared with sizes before the generated encoder runs.
/// Types whose last field is `int64_t seal` carry a checksum of the bytes before it: a changed
/// message is refused instead of believed. A sender that knows no seal (plain LCM code of a robot)
/// leaves 0 there. Everything here is thread-safe and keeps no state.
namespace prospect::messages {

/// A decoded message, or the reason why there is none.
template <class T>
struct DecodeResult {
  T value{};
  /// Null when decoded. Otherwise "fingerprint" (not this type), "truncated" (ends inside a field),
  /// "length" (a count or string length that is negative or exceeds the bytes left, a string
  /// without its zero), "trailing" (bytes left over), "seal" (changed on the way), or "decoder"
  /// (the generated decoder disagrees with the schema).
  const char* reason = nullptr;

  bool ok() const { return reason == nullptr; }
};

/// Whether `size` bytes at `data` are one whole message of `type`, fingerprint included. Allocates
/// nothing and reads each byte at most once. @return null when they are, else the reason as in
/// DecodeResult
const char* WalkMessage(const TypeSchema& type, const void* data, std::size_t size);

/// Whether a message that WalkMessage found whole is as its sender sealed it: true too for types
/// without a seal and for senders that made none. Finds every change within eight bytes, and any
/// other but for one in 2^64.
bool SealHolds(const TypeSchema& type, const void* data, std::size_t size);

/// Writes the seal of a whole message of `type`; does nothing for types without one.
void Seal(const TypeSchema& type, std::vector<std::uint8_t>* bytes);

/// Decodes one message after walking it. Never throws for bad bytes, and allocates no more than a
/// small multiple of `size`.
/// @param data may be null when size is 0
template <class T>
DecodeResult<T> CheckedDecode(const void* data, std::size_t size) {
  DecodeResult<T> result;
  result.reason = WalkMessage(SchemaOf<T>(), data, size);
  if (!result.reason && !SealHolds(SchemaOf<T>(), data, size)) result.reason = "seal";
  if (result.reason) return result;
  try {
    const int length = static_cast<int>(size);
    if (result.value.decode(data, 0, length) != length) result.reason = "decoder";
  } catch (const std::exception&) {
    result.reason = "decoder";
  }
  if (result.reason) result.value = T{};
  return result;
}

/// The bytes of `message`, sealed whatever its own `seal` field holds. @throws EncodeError as
/// RequireCounts does
template <class T>
std::vector<std::uint8_t> CheckedEncode(const T& message) {
  RequireCounts(message);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = static_cast<int>(bytes.size());
  if (message.encode(bytes.data(), 0, size) != size) {
    throw EncodeError(std::string(T::getTypeName()) + " could not be encoded");
  }
  Seal(SchemaOf<T>(), &bytes);
  return bytes;
}

}  // namespace prospect::messages
