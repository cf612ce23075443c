// SPDX-License-Identifier: Apache-2.0
// SUMO's table of vehicle classes: "Vehicle Type Parameter Defaults" of its documentation, as of SUMO 1.18. Digits at
// the end of a word, and characters other than letters, only number or separate the words of a name.
#include "motion/vehicle_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "motion/input_text.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

struct Class {
  std::string_view name;
  double length_m, width_m, height_m;
};

constexpr Class classes[] = {
    {"passenger", 5, 1.8, 1.5},
    {"private", 5, 1.8, 1.5},
    {"taxi", 5, 1.8, 1.5},
    {"hov", 5, 1.8, 1.5},
    {"vip", 5, 1.8, 1.5},
    {"evehicle", 5, 1.8, 1.5},
    {"custom1", 5, 1.8, 1.5},
    {"custom2", 5, 1.8, 1.5},
    {"authority", 5, 1.8, 1.5},
    {"army", 5, 1.8, 1.5},
    {"emergency", 6.5, 2.16, 2.86},
    {"delivery", 6.5, 2.16, 2.86},
    {"truck", 7.1, 2.4, 2.4},
    {"trailer", 16.5, 2.55, 4},
    {"bus", 12, 2.5, 3.4},
    {"coach", 14, 2.6, 4},
    {"motorcycle", 2.2, 0.9, 1.5},
    {"moped", 2.1, 0.78, 1.7},
    {"bicycle", 1.6, 0.65, 1.7},
    {"pedestrian", 0.215, 0.478, 1.719},
    {"tram", 22, 2.4, 3.2},
    {"rail_urban", 109.5, 3, 3.6},
    {"rail", 135, 2.84, 3.75},
    {"rail_electric", 200, 2.95, 3.89},
    {"rail_fast", 200, 2.95, 3.89},
    {"ship", 17, 4, 4},
    {"default_vehtype", 5, 1.8, 1.5},
    {"default_taxitype", 5, 1.8, 1.5},
    {"default_biketype", 1.6, 0.65, 1.7},
    {"default_pedtype", 0.215, 0.478, 1.719},
    {"default_railtype", 135, 2.84, 3.75},
    {"default_containertype", 6.1, 2.4, 2.6},
    {"car", 5, 1.8, 1.5},
    {"van", 6.5, 2.16, 2.86},
    {"lorry", 7.1, 2.4, 2.4},
    {"bike", 1.6, 0.65, 1.7},
};

const Class* find(std::string_view word) {
  const auto found =
      std::find_if(std::begin(classes), std::end(classes), [&](const Class& c) { return c.name == word; });
  return found == std::end(classes) ? nullptr : found;
}

const Class* find_by_words(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz";
  for (size_t at = name.find_first_of(letters); at != name.npos; at = name.find_first_of(letters, at)) {
    const size_t end = std::min(name.find_first_not_of(letters, at), name.size());
    if (const Class* const found = find(name.substr(at, end - at))) return found;
    at = end;
  }
  return nullptr;
}

const Class* class_of(std::string_view name) {
  const std::string lower = lower_case(name);
  const Class* const found = find(lower);
  return found ? found : find_by_words(lower);
}

}  // namespace

std::string_view vehicle_class(std::string_view name) {
  const Class* const found = class_of(name);
  return found ? found->name : std::string_view();
}

std::optional<VehicleType> sumo_type(std::string_view name) {
  const Class* const found = class_of(name);
  if (!found) return std::nullopt;
  return VehicleType{std::string(name), found->length_m, found->width_m, found->height_m};
}

void check_type(const VehicleType& type) {
  if (type.length_m == 0 && type.width_m == 0 && type.height_m == 0)
    return;  // it has no body: [[vehicle_type]] model = "none"
  for (const double size_m : {type.length_m, type.width_m, type.height_m}) {
    if (size_m > 0 && size_m < std::numeric_limits<double>::infinity()) continue;
    throw ConfigError(fmt::format(
        "vehicle type '{}': {} m is not a valid size; length, width and height must be positive", type.name, size_m));
  }
}

}  // namespace wavetracer
