// Counts in JSON that may be anybody's: nlohmann turns numbers into others without a word, even where that is
// undefined.
#pragma once
#include <fmt/format.h>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace wavetracer {

// Throws nlohmann's type_error where the value is no whole number that T holds.
template <typename T>
T whole(const nlohmann::ordered_json& json) {
  if (!json.is_number_unsigned() || json.get<uint64_t>() > std::numeric_limits<T>::max())
    throw nlohmann::ordered_json::type_error::create(
        302, fmt::format("a value of the type {} is no count", json.type_name()), &json);
  return json.get<T>();
}

}  // namespace wavetracer
