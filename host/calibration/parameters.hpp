// SPDX-License-Identifier: Apache-2.0
// The properties of materials that are fitted. Each is a function of a number theta that is 0 at the start:
// permittivity 1 + (e - 1) exp(theta), conductivity and thickness x exp(theta), the scattering coefficient logistic in
// theta. So no value of theta leaves the range of a property.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>
#include "wavetracer/device/field_records.h"
#include "wavetracer/scene.hpp"

namespace wavetracer::calibration {

enum class Property { permittivity, conductivity, thickness, scattering };
std::string name_of(Property property);
std::string unit_of(Property property);  // empty: a plain number

// The value of a property in a record at a carrier, in the property's unit.
double value_of(const device::wt_material& record, Property property, double frequency_hz);

struct Parameter {
  std::string material;
  Property property = Property::permittivity;
  double start = 0;               // value of the configuration, in its unit
  double prior = 0;               // standard deviation of theta before anything was measured
  std::vector<uint32_t> records;  // the materials of that name in the list of the world

  double value(double theta) const;
  // Standard error of the value for that of theta.
  double error(double theta, double error_of_theta) const;
  std::string name() const { return material + "." + name_of(property); }
};

// A material of the world: names, in the order of the records that fields use.
struct NamedRecords {
  std::vector<std::string> names;            // empty for walls of layers: their layers are fitted
  std::vector<device::wt_material> records;  // those that no surface uses are all zeros
  std::vector<bool> in_walls;                // layers of walls, whose thickness is not that of their material
  double frequency_hz = 0;
  bool scatters = false;  // trace.scattering is on
};

// Returns the parameters that the patterns choose, each MATERIAL or MATERIAL.PROPERTY with * and ? as in shells; a
// material alone stands for its permittivity and conductivity. prior: factor of the standard deviations of priors.
// notes: gets a sentence for each property that a pattern names and that cannot be fitted. Throws ConfigError for a
// pattern that chooses nothing, or an unknown property.
std::vector<Parameter> chosen_parameters(const NamedRecords& world, const std::vector<std::string>& patterns,
                                         double prior, std::vector<std::string>& notes);

// Returns the records with these values of theta; a theta of 0 leaves every bit of its property alone.
std::vector<device::wt_material> with_parameters(const NamedRecords& world, std::span<const Parameter> parameters,
                                                 std::span<const double> theta);

}  // namespace wavetracer::calibration
