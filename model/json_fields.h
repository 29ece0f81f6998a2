#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace prospect::model {

/// Reads named fields of one JSON object into variables and refuses names it was not asked for, so
/// that a misspelt option is an error and not a default.
class JsonFields {
 public:
  /// `where` names the object in messages, e.g. "network".
  JsonFields(const nlohmann::json& object, std::string where)
      : object_(object), where_(std::move(where)) {
    if (!object.is_object()) throw std::invalid_argument(where_ + ": must be a JSON object");
  }

  /// Sets `*value` if the key is there. Throws std::invalid_argument on a wrong type.
  template <typename T>
  JsonFields& Read(const std::string& key, T* value) {
    known_.push_back(key);
    const auto found = object_.find(key);
    if (found == object_.end()) return *this;
    if (!Fits<T>(*found)) {
      throw std::invalid_argument(where_ + "." + key + ": has the wrong type or does not fit (" +
                                  found->dump() + ")");
    }
    try {
      found->get_to(*value);  // nested objects keep what the JSON does not name
    } catch (const nlohmann::json::exception&) {
      throw std::invalid_argument(where_ + "." + key + ": has the wrong type");
    }
    return *this;
  }

  /// Throws std::invalid_argument if the object has a key that no Read asked for.
  void RefuseOthers() const {
    for (const auto& item : object_.items()) {
      bool found = false;
      for (const std::string& key : known_) found = found || key == item.key();
      if (!found) throw std::invalid_argument(where_ + "." + item.key() + ": is not an option");
    }
  }

 private:
  /// The library would cut 2.7 to 2, wrap what is too large around and take true for 1.
  template <typename T>
  static bool Fits(const nlohmann::json& value) {
    if constexpr (std::is_same_v<T, bool>) return value.is_boolean();
    if constexpr (std::is_floating_point_v<T>) return value.is_number();
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      if (!value.is_number_integer()) return false;
      if (value.is_number_unsigned())
        return value.get<std::uint64_t>() <=
               static_cast<std::uint64_t>(std::numeric_limits<T>::max());
      return std::is_signed_v<T> &&
             value.get<std::int64_t>() >= static_cast<std::int64_t>(std::numeric_limits<T>::min());
    }
    return true;
  }

  const nlohmann::json& object_;
  std::string where_;
  std::vector<std::string> known_;
};

}  // namespace prospect::model
