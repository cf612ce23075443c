// SPDX-License-Identifier: Apache-2.0
#include "calibration/parameters.hpp"
#include <fmt/format.h>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include "base/spelling.hpp"
#include "radio/constants.hpp"
#include "simulation/name_pattern.hpp"
#include "wavetracer/device/slab.h"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

constexpr size_t property_count = 4;
constexpr std::array<const char*, property_count> property_names{"permittivity", "conductivity", "thickness",
                                                                 "scattering"};
constexpr std::array<const char*, property_count> units{"", "S/m", "m", ""};
// Standard deviations of theta: laws of materials of one name differ by about so much (docs/design/calibration.md).
constexpr std::array<double, property_count> priors{0.5, 1.0, 0.5, 1.0};

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

// Conductivity of 1 S/m as the imaginary part of a relative permittivity.
double imaginary_part(double frequency_hz) {
  return 1 / (2 * std::numbers::pi * frequency_hz * vacuum_permittivity_f_m);
}

void set_value(device::wt_material& record, Property property, double value, double frequency_hz) {
  switch (property) {
    case Property::permittivity:
      record.permittivity[0] = value;
      break;
    case Property::conductivity:
      record.permittivity[1] = -value * imaginary_part(frequency_hz);
      break;
    case Property::thickness:
      record.thickness_m = value;
      break;
    default:
      record.scattering = value;
  }
}

// Returns why the property cannot be fitted; empty if it can.
std::string obstacle(const device::wt_material& record, Property property, const NamedRecords& world) {
  if (std::hypot(record.permittivity[0], record.permittivity[1]) > WT_CONDUCTS)
    return "it is a good conductor, which reflects everything";
  const double value = value_of(record, property, world.frequency_hz);
  if (property == Property::permittivity) return value > 1 ? "" : "it is that of air";
  if (property == Property::thickness)
    return value > 0 && std::isfinite(value) ? "" : fmt::format("it is {:g} m in the configuration", value);
  if (property == Property::scattering && !world.scatters) return "trace.scattering is off";
  if (!(value > 0)) return "it is 0 in the configuration; give it a value to start from";
  return value < 1 || property == Property::conductivity ? "" : "it is 1 in the configuration";
}

bool is_unused(const device::wt_material& record) { return record.permittivity[0] == 0; }

struct Pattern {
  std::string material;
  std::vector<Property> properties;
  bool all_properties = false;  // it names none
};

Pattern parse_pattern(const std::string& text) {
  // Names of materials may have dots, so only a known property ends the name.
  const size_t dot = text.rfind('.');
  if (dot == std::string::npos) return {text, {Property::permittivity, Property::conductivity}, true};
  const std::string last = text.substr(dot + 1);
  for (size_t i = 0; i < property_count; ++i)
    if (last == property_names[i]) return {text.substr(0, dot), {static_cast<Property>(i)}};
  throw ConfigError(fmt::format("--fit {}: \"{}\" is no property of a material{}; there are {}", text, last,
                                spelling_hint(last, {property_names.begin(), property_names.end()}),
                                fmt::join(property_names, ", ")));
}

}  // namespace

std::string name_of(Property property) { return property_names[static_cast<size_t>(property)]; }
std::string unit_of(Property property) { return units[static_cast<size_t>(property)]; }

double value_of(const device::wt_material& record, Property property, double frequency_hz) {
  switch (property) {
    case Property::permittivity:
      return record.permittivity[0];
    case Property::conductivity:
      return std::abs(record.permittivity[1]) / imaginary_part(frequency_hz);
    case Property::thickness:
      return record.thickness_m;
    default:
      return record.scattering;
  }
}

double Parameter::value(double theta) const {
  if (property == Property::permittivity) return 1 + (start - 1) * std::exp(theta);
  if (property == Property::scattering) return logistic(std::log(start / (1 - start)) + theta);
  return start * std::exp(theta);
}

double Parameter::error(double theta, double error_of_theta) const {
  const double now = value(theta);
  const double slope = property == Property::permittivity ? now - 1
                       : property == Property::scattering ? now * (1 - now)
                                                          : now;
  return slope * error_of_theta;
}

std::vector<Parameter> chosen_parameters(const NamedRecords& world, const std::vector<std::string>& patterns,
                                         double prior, std::vector<std::string>& notes) {
  std::map<std::string, std::vector<uint32_t>> records;
  for (size_t i = 0; i < world.names.size(); ++i)
    if (!is_unused(world.records[i]) && !world.names[i].empty())
      records[world.names[i]].push_back(static_cast<uint32_t>(i));
  std::vector<Parameter> out;
  const auto add = [&](const std::string& name, std::vector<uint32_t> of, Property property, bool asked) {
    if (property == Property::thickness || property == Property::scattering)
      std::erase_if(of, [&](uint32_t record) { return world.in_walls[record]; });
    const std::string why =
        of.empty() ? "it belongs to the layers of walls" : obstacle(world.records[of.front()], property, world);
    if (!why.empty()) {
      if (asked) notes.push_back(fmt::format("{}.{} is not fitted: {}", name, name_of(property), why));
      return;
    }
    Parameter made{name, property, value_of(world.records[of.front()], property, world.frequency_hz),
                   prior * priors[static_cast<size_t>(property)], of};
    for (const Parameter& other : out)
      if (other.name() == made.name()) return;
    out.push_back(std::move(made));
  };
  for (const std::string& text : patterns) {
    const Pattern pattern = parse_pattern(text);
    bool any = false;
    for (const auto& [name, of] : records)
      if (matches(pattern.material, name)) {
        any = true;
        for (const Property property : pattern.properties) add(name, of, property, !pattern.all_properties);
      }
    if (any) continue;
    std::vector<std::string> known;
    for (const auto& [name, of] : records) known.push_back(name);
    throw ConfigError(fmt::format("--fit {}: no surface has the material \"{}\"{}; there are {}", text,
                                  pattern.material, spelling_hint(pattern.material, known), fmt::join(known, ", ")));
  }
  return out;
}

std::vector<device::wt_material> with_parameters(const NamedRecords& world, std::span<const Parameter> parameters,
                                                 std::span<const double> theta) {
  std::vector<device::wt_material> out = world.records;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (theta[i] == 0) continue;
    for (const uint32_t record : parameters[i].records)
      set_value(out[record], parameters[i].property, parameters[i].value(theta[i]), world.frequency_hz);
  }
  return out;
}

}  // namespace wavetracer::calibration
