#include "lcmtypes/schema.h"

namespace prospect::messages {

const TypeSchema* FindByFingerprint(std::int64_t fingerprint) {
  for (const TypeSchema& type : Schema()) {
    if (type.fingerprint == fingerprint) return &type;
  }
  return nullptr;
}

const TypeSchema* FindByName(const std::string& name) {
  for (const TypeSchema& type : Schema()) {
    if (name == type.name) return &type;
  }
  return nullptr;
}

std::int64_t FingerprintOf(const void* data, std::size_t size) {
  if (size < 8) return 0;
  std::uint64_t value = 0;
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  for (int i = 0; i < 8; ++i) value = (value << 8) | bytes[i];
  return static_cast<std::int64_t>(value);
}

}  // namespace prospect::messages
