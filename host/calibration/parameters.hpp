// SPDX-License-Identifier: Apache-2.0
// The numbers that are fitted. Each is a function of a number theta that is 0 at the start: permittivity 1 + (e - 1)
// exp(theta), conductivity and thickness x exp(theta), the scattering coefficient logistic in theta, so that no value
// of theta leaves the range of a property; heights and coordinates x + theta in m, angles x + 10 theta in degrees.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include "wavetracer/device/field_records.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer::calibration {

// Those of materials, then those of ends: coordinates and angles of a transmitter, and the rise of all receivers.
enum class Property { permittivity, conductivity, thickness, scattering, height, x, y, yaw, pitch, roll };
constexpr bool is_of_end(Property property) { return property >= Property::height; }
constexpr bool is_angle(Property property) { return property >= Property::yaw; }
// Does it change paths, and not only their fields?
constexpr bool moves_paths(Property property) { return is_of_end(property) && !is_angle(property); }
std::string name_of(Property property);
// Returns the property of that name; nothing if there is none.
std::optional<Property> property_named(std::string_view name);
// The names of properties of materials, or those of ends.
std::vector<std::string> property_names(bool of_ends);
std::string unit_of(Property property);  // empty: a plain number
// Standard deviation of theta before anything was measured.
double usual_prior(Property property);
// Change of the value for one of theta; only properties of ends have it.
double unit_of_theta(Property property);

// The value of a material's property in a record at a carrier, in the property's unit.
double value_of(const device::wt_material& record, Property property, double frequency_hz);

constexpr const char* all_receivers = "receivers";

struct Parameter {
  std::string owner;  // a material, a transmitter, or all_receivers
  Property property = Property::permittivity;
  double start = 0;               // value of the configuration, in its unit
  double prior = 0;               // standard deviation of theta before anything was measured
  std::vector<uint32_t> records;  // the materials of that name in the list of the world; of an end none
  uint32_t transmitter = no_end;  // its number; no_end for materials and receivers

  double value(double theta) const;
  // Standard error of the value for that of theta.
  double error(double theta, double error_of_theta) const;
  std::string name() const { return owner + "." + name_of(property); }
};

// A material of the world: names, in the order of the records that fields use.
struct NamedRecords {
  std::vector<std::string> names;            // empty for walls of layers: their layers are fitted
  std::vector<device::wt_material> records;  // those that no surface uses are all zeros
  std::vector<bool> in_walls;                // layers of walls, whose thickness is not that of their material
  double frequency_hz = 0;
  bool scatters = false;  // trace.scattering is on
};

// Returns the records with the parameters of materials at these values of theta; a theta of 0 leaves every bit of its
// property alone.
std::vector<device::wt_material> with_parameters(const NamedRecords& world, std::span<const Parameter> parameters,
                                                 std::span<const double> theta);

}  // namespace wavetracer::calibration
