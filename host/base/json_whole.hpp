// SPDX-License-Identifier: Apache-2.0
// Reads whole numbers from JSON files that other programs wrote: nlohmann converts a number silently, even where the
// conversion is undefined.
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

// Returns the number as a T, or nothing if T cannot hold it. 3.0 counts as whole, since JSON has only one kind of
// number.
template <std::integral T, typename Json>
std::optional<T> whole_number(const Json& value) {
  constexpr double exact = 0x1p53;  // a double holds every whole number up to this one
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

// Throws nlohmann's type_error if the value is not a whole number that T can hold. key: name of the value, for the
// message. where: name of the object around it, for the message; empty if the caller adds it.
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

// Returns a member of an object as a whole number. Throws as above, and nlohmann's error if the member is missing.
template <std::integral T, typename Json>
T whole_at(const Json& object, const char* key, std::string_view where = {}) {
  return whole<T>(object.at(key), key, where);
}

// Does the same, but returns nothing if the member is missing.
template <std::integral T, typename Json>
T whole_or(const Json& object, const char* key, T absent, std::string_view where = {}) {
  return object.contains(key) ? whole_at<T>(object, key, where) : absent;
}

// Returns a member that is a list of whole numbers. Throws as above.
template <std::integral T, typename Json>
std::vector<T> whole_list(const Json& object, const char* key) {
  std::vector<T> out;
  for (const Json& value : object.at(key).template get_ref<const typename Json::array_t&>())
    out.push_back(whole<T>(value, key));
  return out;
}

}  // namespace wavetracer
