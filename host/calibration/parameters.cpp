// SPDX-License-Identifier: Apache-2.0
#include "calibration/parameters.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include "radio/constants.hpp"

namespace wavetracer::calibration {
namespace {

struct Kind {
  std::string_view name, unit;
  double prior;              // laws of materials of one name differ by about so much (docs/calibration.md)
  double unit_of_theta = 0;  // only of ends
};
// In the order of Property.
constexpr std::array kinds{Kind{"permittivity", "", 0.5}, Kind{"conductivity", "S/m", 1.0},
                           Kind{"thickness", "m", 0.5},   Kind{"scattering", "", 1.0},
                           Kind{"height", "m", 0.5, 1},   Kind{"x", "m", 0.5, 1},
                           Kind{"y", "m", 0.5, 1},        Kind{"yaw", "deg", 0.5, 10},
                           Kind{"pitch", "deg", 0.5, 10}, Kind{"roll", "deg", 0.5, 10}};

const Kind& kind_of(Property property) { return kinds[static_cast<size_t>(property)]; }

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

}  // namespace

std::string name_of(Property property) { return std::string(kind_of(property).name); }
std::string unit_of(Property property) { return std::string(kind_of(property).unit); }
double usual_prior(Property property) { return kind_of(property).prior; }
double unit_of_theta(Property property) { return kind_of(property).unit_of_theta; }

std::optional<Property> property_named(std::string_view name) {
  const auto found = std::ranges::find(kinds, name, &Kind::name);
  return found == kinds.end() ? std::nullopt : std::optional(static_cast<Property>(found - kinds.begin()));
}

std::vector<std::string> property_names(bool of_ends) {
  std::vector<std::string> out;
  for (size_t i = 0; i < kinds.size(); ++i)
    if (is_of_end(static_cast<Property>(i)) == of_ends) out.emplace_back(kinds[i].name);
  return out;
}

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
  if (is_of_end(property)) return start + unit_of_theta(property) * theta;
  if (property == Property::permittivity) return 1 + (start - 1) * std::exp(theta);
  if (property == Property::scattering) return logistic(std::log(start / (1 - start)) + theta);
  return start * std::exp(theta);
}

double Parameter::error(double theta, double error_of_theta) const {
  if (is_of_end(property)) return unit_of_theta(property) * error_of_theta;
  const double now = value(theta);
  const double slope = property == Property::permittivity ? now - 1
                       : property == Property::scattering ? now * (1 - now)
                                                          : now;
  return slope * error_of_theta;
}

std::vector<device::wt_material> with_parameters(const NamedRecords& world, std::span<const Parameter> parameters,
                                                 std::span<const double> theta) {
  std::vector<device::wt_material> out = world.records;
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (theta[i] == 0 || is_of_end(parameters[i].property)) continue;
    for (const uint32_t record : parameters[i].records)
      set_value(out[record], parameters[i].property, parameters[i].value(theta[i]), world.frequency_hz);
  }
  return out;
}

}  // namespace wavetracer::calibration
