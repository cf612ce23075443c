// Reads whole numbers of JSON from files of others: nlohmann turns numbers into other ones without a word, even where
// that is undefined.
#pragma once
#include <fmt/format.h>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace wavetracer {

// The number as a T; empty where it is none that T holds. 3.0 is whole, as JSON has one kind of numbers only.
template <std::integral T, typename Json>
std::optional<T> whole_number(const Json& value) {
  constexpr double exact = 0x1p53;  // up to here a double holds each whole number
  if (value.is_number_unsigned()) {
    const auto number = value.template get<uint64_t>();
    if (std::in_range<T>(number)) return static_cast<T>(number);
  } else if (value.is_number_integer()) {
    const auto number = value.template get<int64_t>();
    if (std::in_range<T>(number)) return static_cast<T>(number);
  } else if (value.is_number_float()) {
    const auto number = value.template get<double>();
    if (std::abs(number) <= exact && std::trunc(number) == number && std::in_range<T>(static_cast<int64_t>(number)))
      return static_cast<T>(number);
  }
  return std::nullopt;
}

// Throws nlohmann's type_error where the value is no whole number that T holds. key: its name, for that message;
// where: the name of the object around it, for the message too; empty if the caller adds it.
template <std::integral T, typename Json>
T whole(const Json& value, std::string_view key, std::string_view where = {}) {
  if (const std::optional<T> number = whole_number<T>(value)) return *number;
  throw Json::type_error::create(
      302,
      fmt::format("{}{}\"{}\" is {}, but must be a whole number from {} to {}", where, where.empty() ? "" : ": ", key,
                  value.is_number() ? value.dump() : fmt::format("of the type {}", value.type_name()),
                  std::numeric_limits<T>::min(), std::numeric_limits<T>::max()),
      &value);
}

// The member of an object as a whole number. Throws as above, and nlohmann's error where the member is not there.
template <std::integral T, typename Json>
T whole_at(const Json& object, const char* key, std::string_view where = {}) {
  return whole<T>(object.at(key), key, where);
}

// The same; absent where the member is not there.
template <std::integral T, typename Json>
T whole_or(const Json& object, const char* key, T absent, std::string_view where = {}) {
  return object.contains(key) ? whole_at<T>(object, key, where) : absent;
}

// A member that is a list of whole numbers. Throws as above.
template <std::integral T, typename Json>
std::vector<T> whole_list(const Json& object, const char* key) {
  std::vector<T> out;
  for (const Json& value : object.at(key).template get_ref<const typename Json::array_t&>())
    out.push_back(whole<T>(value, key));
  return out;
}

}  // namespace wavetracer
