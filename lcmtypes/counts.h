#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "lcmtypes/fields.h"

/// The counts (num_x) of a message and the sizes of its arrays, which LCM's types keep apart.
namespace prospect::messages {

/// A count that differs from its array's size: a fault of the program that filled the message.
class EncodeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sets every count (num_x) of `message` and of the messages inside it to the size of its array.
/// @throws EncodeError when two arrays that share a count differ in size, naming both
template <class T>
void SetCounts(T& message);

/// Compares every count with its arrays' sizes. @throws EncodeError naming type and field when one
/// differs
template <class T>
void RequireCounts(const T& message);

namespace internal {

[[noreturn]] inline void ThrowCount(const char* type, const char* field, long count,
                                    std::size_t size) {
  throw EncodeError(std::string(type) + "." + field + " holds " + std::to_string(size) +
                    " elements but its count says " + std::to_string(count) +
                    ": call SetCounts() after filling arrays");
}

template <class T>
struct CountChecker {
  template <class V>
  void Value(const char*, const V& value) {
    if constexpr (Fields<V>::kIsMessage) RequireCounts(value);
  }
  void Count(const char*, std::int32_t) {}
  template <class V>
  void Array(const char* name, std::int32_t count, const std::vector<V>& values) {
    if (count < 0 || static_cast<std::size_t>(count) != values.size()) {
      ThrowCount(T::getTypeName(), name, count, values.size());
    }
    if constexpr (Fields<V>::kIsMessage) {
      for (const V& value : values) RequireCounts(value);
    }
  }
};

template <class T>
struct CountSetter {
  static constexpr std::int32_t kUnset = -1;

  template <class V>
  void Value(const char*, V& value) {
    if constexpr (Fields<V>::kIsMessage) SetCounts(value);
  }
  void Count(const char*, std::int32_t& count) { count = kUnset; }
  // Arrays follow their count on the wire, so the first one sets it and the others must agree.
  template <class V>
  void Array(const char* name, std::int32_t& count, std::vector<V>& values) {
    if (count == kUnset) count = static_cast<std::int32_t>(values.size());
    if (static_cast<std::size_t>(count) != values.size()) {
      ThrowCount(T::getTypeName(), name, count, values.size());
    }
    if constexpr (Fields<V>::kIsMessage) {
      for (V& value : values) SetCounts(value);
    }
  }
};

}  // namespace internal

template <class T>
void SetCounts(T& message) {
  internal::CountSetter<T> setter;
  Fields<T>::Visit(message, setter);
}

template <class T>
void RequireCounts(const T& message) {
  internal::CountChecker<T> checker;
  Fields<T>::Visit(message, checker);
}

}  // namespace prospect::messages
