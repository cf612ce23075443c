// SPDX-License-Identifier: Apache-2.0
// The antenna of a radio end: an element pattern, one or two ports, turned into the global frame.
// Everything is per port: ports of one antenna share place and pattern and differ in polarisation.
// wavetracer/device/antenna.h computes fields, here as on devices.
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <vector>

#include "radio/pattern.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/antenna.h"

namespace wavetracer {

// The rotation from the antenna's frame to the global one: yaw about z, then pitch about the new y, then roll about the
// new x, in degrees (3GPP TR 38.901, eq. 7.1-2). A positive pitch turns the boresight +x down.
glm::dmat3 rotation_of(const std::array<double, 3>& orientation_deg);

class Antenna {
 public:
  // pattern: one of WT_PATTERN_*; grid: its samples where it is WT_PATTERN_GRID.
  // slants_rad: one per port, the angle by which the pattern's field is turned about the direction of travel, from
  // theta-hat (V) towards phi-hat (H): the polarisation model of TR 38.901, eq. 7.3-4 and 7.3-5. The shape of the
  // pattern stays; to lay a dipole down, use the orientation.
  Antenna(uint32_t pattern, const PatternGrid& grid, const std::vector<double>& slants_rad, const glm::dmat3& rotation);

  uint32_t ports() const { return record_.ports; }
  // The rotation of its own orientation.
  const glm::dmat3& rotation() const { return to_global_; }
  const device::wt_antenna& record() const { return record_; }
  const std::vector<double>& samples() const { return samples_; }

  // The field pattern of a port along the spherical unit vectors of a global direction, in the antenna's own
  // orientation. The direction has unit length and points away from the antenna. The squared length of the field is the
  // gain over isotropic. By reciprocity it serves sending and receiving alike.
  FieldPair field(uint32_t port, const glm::dvec3& direction) const;

 private:
  device::wt_antenna record_{};
  std::vector<double> samples_;
  glm::dmat3 to_global_;
};

// Polarisations are "V"; "H"; "VH" (port 0 is V, port 1 is H); "cross" (port 0 is slanted by +45 degrees, port 1 by
// -45).
// Throws ConfigError if the antenna or the polarisation is unknown, InputError if the pattern file is malformed.
Antenna make_antenna(const RadioEnd& end);

}  // namespace wavetracer
