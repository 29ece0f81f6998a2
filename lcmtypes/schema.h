#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// The message types as a table, made from the .lcm files at build time by schema_gen. With it code
/// can walk bytes, list channels and fill messages at random without being written once per type.
/// Immutable after start; thread-safe.
namespace prospect::messages {

enum class FieldKind : std::uint8_t {
  kByte,
  kBoolean,
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kFloat,
  kDouble,
  kString,
  kStruct
};

/// Most fields a type may have; the generator refuses more. It bounds WalkMessage's fixed scratch.
inline constexpr int kMaxFields = 64;

/// One field, in wire order.
struct FieldSchema {
  const char* name;
  FieldKind kind;
  int struct_index;  ///< row of the table for kStruct, else -1
  int count_field;   ///< index of the field that counts this array; -1: no array
  int min_bytes;     ///< least bytes one element takes on the wire
};

/// A named constant of a type.
struct ConstantSchema {
  const char* name;
  std::int64_t value;
};

/// One message type.
struct TypeSchema {
  const char* name;          ///< such as "observation_t"
  std::int64_t fingerprint;  ///< first eight bytes of an encoded message
  std::vector<FieldSchema> fields;
  std::vector<ConstantSchema> constants;
  int min_bytes;  ///< least bytes on the wire, without the fingerprint
};

/// All types, by name in alphabetical order.
const std::vector<TypeSchema>& Schema();

/// The type with this fingerprint, or null.
const TypeSchema* FindByFingerprint(std::int64_t fingerprint);

/// The type with this name ("observation_t"), or null.
const TypeSchema* FindByName(const std::string& name);

/// The fingerprint that a message begins with; 0 when `size` is below 8.
std::int64_t FingerprintOf(const void* data, std::size_t size);

/// The schema of a generated type.
template <class T>
const TypeSchema& SchemaOf() {
  static const TypeSchema& type = *FindByName(T::getTypeName());
  return type;
}

}  // namespace prospect::messages
