#pragma once

#include <cstring>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/messages.h"

/// Messages filled at random by schema, so that one test serves all types. Numbers take any bits
/// (infinities and NaNs too), strings any bytes but zero. The same generator state gives the same
/// message.
namespace prospect::messages {

class RandomFiller {
 public:
  RandomFiller(std::mt19937_64& random, int max_elements)
      : random_(random), max_elements_(max_elements) {}

  template <class V>
  void Value(const char*, V& value) {
    Fill(value);
  }
  void Count(const char*, std::int32_t& count) {
    count = static_cast<std::int32_t>(random_() % static_cast<unsigned>(max_elements_ + 1));
  }
  template <class V>
  void Array(const char*, std::int32_t count, std::vector<V>& values) {
    values.resize(static_cast<std::size_t>(count));
    for (V& value : values) Fill(value);
  }

 private:
  void Fill(std::string& text) {
    text.resize(random_() % 12);
    for (char& c : text) c = static_cast<char>(1 + random_() % 255);
  }

  template <class V>
  void Fill(V& value) {
    if constexpr (Fields<V>::kIsMessage) {
      RandomFiller inner(random_, 3);
      Fields<V>::Visit(value, inner);
    } else {
      const std::uint64_t bits = random_();
      std::memcpy(&value, &bits, sizeof value);
    }
  }

  std::mt19937_64& random_;
  int max_elements_;
};

template <class T>
T RandomMessage(std::mt19937_64& random, int max_elements = 6) {
  T message{};
  RandomFiller filler(random, max_elements);
  Fields<T>::Visit(message, filler);
  return message;
}

#define PROSPECT_TYPE_WITH_COMMA(type) , type
template <class First, class... Types>
struct DropFirst {
  template <template <class...> class List>
  using As = List<Types...>;
};
/// AllTypes::As<testing::Types> lists every message type.
using AllTypes = DropFirst<void PROSPECT_MESSAGE_TYPES(PROSPECT_TYPE_WITH_COMMA)>;

}  // namespace prospect::messages
