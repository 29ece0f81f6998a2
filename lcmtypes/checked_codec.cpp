#include "lcmtypes/checked_codec.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/hash.h"

namespace prospect::messages {
namespace {

// Steps over one message's bytes, never past their end. `reason` stays null while all is well.
class Walker {
 public:
  Walker(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  const char* reason() const { return reason_; }
  std::size_t left() const { return left_; }

  bool Skip(std::size_t bytes) {
    if (bytes > left_) return Refuse("truncated");
    at_ += bytes;
    left_ -= bytes;
    return true;
  }

  bool WalkStruct(const TypeSchema& type) {
    // Values of the counts met so far, by field. A field that counts no array costs nothing to
    // keep.
    std::array<std::int32_t, kMaxFields> counts;
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      const FieldSchema& field = type.fields[i];
      if (field.kind == FieldKind::kInt32 && field.count_field < 0) {
        if (!ReadInt32(counts[i])) return false;
      } else if (!WalkField(field, field.count_field < 0 ? 1 : counts[field.count_field])) {
        return false;
      }
    }
    return true;
  }

 private:
  bool Refuse(const char* reason) {
    reason_ = reason;
    return false;
  }

  bool ReadInt32(std::int32_t& value) {
    if (left_ < 4) return Refuse("truncated");
    const std::uint32_t bits = (std::uint32_t{at_[0]} << 24) | (std::uint32_t{at_[1]} << 16) |
                               (std::uint32_t{at_[2]} << 8) | std::uint32_t{at_[3]};
    value = static_cast<std::int32_t>(bits);
    return Skip(4);
  }

  // Comparing with the least an element takes bounds both the time below and what the decoder will
  // allocate.
  bool WalkField(const FieldSchema& field, std::int32_t count) {
    const bool array = field.count_field >= 0;
    if (array && (count < 0 || static_cast<std::size_t>(count) > left_ / field.min_bytes)) {
      return Refuse("length");
    }
    if (field.kind != FieldKind::kString && field.kind != FieldKind::kStruct) {
      return Skip(static_cast<std::size_t>(count) * field.min_bytes);
    }
    for (std::int32_t i = 0; i < count; ++i) {
      if (!WalkElement(field)) return false;
    }
    return true;
  }

  bool WalkElement(const FieldSchema& field) {
    return field.kind == FieldKind::kString ? WalkString()
                                            : WalkStruct(Schema()[field.struct_index]);
  }

  // The length on the wire includes the closing zero, which must be the only one: the encoder would
  // stop at an earlier one, so no honest sender makes it.
  bool WalkString() {
    std::int32_t length = 0;
    if (!ReadInt32(length)) return false;
    if (length < 1 || static_cast<std::size_t>(length) > left_) return Refuse("length");
    const auto bytes = static_cast<std::size_t>(length);
    if (std::memchr(at_, 0, bytes) != at_ + bytes - 1) return Refuse("length");
    return Skip(static_cast<std::size_t>(length));
  }

  const std::uint8_t* at_;
  std::size_t left_;
  const char* reason_ = nullptr;
};

constexpr std::size_t kLargestMessage = std::size_t{1} << 28;  // LCM's own limit
constexpr std::size_t kSealBytes = 8;

bool HasSeal(const TypeSchema& type) {
  return !type.fields.empty() && std::strcmp(type.fields.back().name, "seal") == 0;
}

// Eight bytes at `at`, the first the lowest: the same number on every machine.
std::uint64_t LittleEndian(const std::uint8_t* at, std::size_t size) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < size; ++i) word |= std::uint64_t{at[i]} << (8 * i);
  return word;
}

// FNV-1a's steps over words of eight bytes, with what FNV lacks for words: the high half is folded
// down after each. Each step is a bijection of the state and of the word,
// so no change within one word can go unseen. Never 0, which means that there is no seal.
std::uint64_t SealOf(const std::uint8_t* data, std::size_t size) {
  std::uint64_t hash = base::kHashStart ^ size;
  for (std::size_t at = 0; at < size; at += 8) {
    hash = (hash ^ LittleEndian(data + at, std::min<std::size_t>(8, size - at))) * base::kHashPrime;
    hash ^= hash >> 32;
  }
  return hash ? hash : 1;
}

std::uint64_t SealIn(const std::uint8_t* data, std::size_t size) {
  return LittleEndian(data + size - kSealBytes, kSealBytes);
}

}  // namespace

const char* WalkMessage(const TypeSchema& type, const void* data, std::size_t size) {
  if (size < 8) return "truncated";
  if (size > kLargestMessage) return "length";
  if (FingerprintOf(data, size) != type.fingerprint) return "fingerprint";
  Walker walker(static_cast<const std::uint8_t*>(data), size);
  walker.Skip(8);
  if (!walker.WalkStruct(type)) return walker.reason();
  return walker.left() == 0 ? nullptr : "trailing";
}

bool SealHolds(const TypeSchema& type, const void* data, std::size_t size) {
  if (!HasSeal(type)) return true;
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  const std::uint64_t seal = SealIn(bytes, size);
  return seal == 0 || seal == SealOf(bytes, size - kSealBytes);
}

void Seal(const TypeSchema& type, std::vector<std::uint8_t>* bytes) {
  if (!HasSeal(type)) return;
  const std::size_t covered = bytes->size() - kSealBytes;
  const std::uint64_t seal = SealOf(bytes->data(), covered);
  for (std::size_t i = 0; i < kSealBytes; ++i) {
    (*bytes)[covered + i] = static_cast<std::uint8_t>(seal >> (8 * i));
  }
}

}  // namespace prospect::messages
