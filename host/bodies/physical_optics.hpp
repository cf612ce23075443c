// SPDX-License-Identifier: Apache-2.0
// Computes the waves that a body of facets scatters from one point to another, by physical optics and exact images:
// docs/radar.md has the model and its errors.
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "bodies/body.hpp"
#include "bodies/lit_parts.hpp"

namespace wavetracer {

struct PhysicalOptics {
  uint32_t max_bounces = 3;  // facets in a chain: all but the last reflect as mirrors, the last one scatters; 1 or more
  // Facets are cut into pieces on which the phase is linear and the amplitude constant up to these errors.
  double phase_error_rad = 0.05;
  double amplitude_error = 0.1;
  // An echo has no larger part of a facet than this, so that its delay and its angles are right. In the far field the
  // sum of all echoes does not depend on it.
  double echo_size_m = std::numeric_limits<double>::infinity();
  // The mean with the transposed result of the way back. Physical optics alone is not reciprocal.
  bool reciprocal = false;
};

// The waves over one part of a facet.
struct Echo {
  std::vector<uint32_t> facets;      // in the order in which the wave meets them
  std::vector<glm::dvec3> vertices;  // the way by the centre of the part; mirrors are endless for it
  double length_m = 0;               // length of that way
  // The field at the receiver without the phase -2 pi length_m / wavelength of that way, row by row. Columns: theta and
  // phi of the direction in which the wave leaves the transmitter; rows: theta and phi of the direction from the
  // receiver to where it comes from; these are the directions by the centre, and both ends are short dipoles along
  // these vectors for all of the part. A path in free space of length L would have 1 / L here. Unit: 1/m.
  std::array<std::complex<double>, 4> matrix{};
};

// A body that is asked more than once: its facets are checked, and what visibility needs is made of them, when it is
// made.
class ScatteringBody {
 public:
  // Throws InputError for a body that check_body refuses.
  explicit ScatteringBody(Body body);
  ScatteringBody(const ScatteringBody&) = delete;
  ScatteringBody& operator=(const ScatteringBody&) = delete;

  // See the functions of these names below.
  std::vector<Echo> scattered(glm::dvec3 transmitter, glm::dvec3 receiver, double frequency_hz,
                              const PhysicalOptics& options = {}) const;
  std::array<double, 4> cross_sections_m2(glm::dvec3 to_transmitter, glm::dvec3 to_receiver, double frequency_hz,
                                          const PhysicalOptics& options = {}) const;

 private:
  Body body_;
  LitParts lit_;
  glm::dvec3 lower_m_, upper_m_;
};

// The echoes of the body, in the order of the number of bounces and then of facets. Ends are points off the body, in
// its frame. Throws InputError for a body that check_body refuses, ConfigError for options out of range, an end that is
// nearer to a facet than 1e-6 m, or a body of which pieces would be smaller than 1e-6 of its size.
std::vector<Echo> scattered(const Body& body, glm::dvec3 transmitter, glm::dvec3 receiver, double frequency_hz,
                            const PhysicalOptics& options = {});

// The sum of echoes with their phases.
std::array<std::complex<double>, 4> sum_of(const std::vector<Echo>& echoes, double frequency_hz);

// Radar cross sections in m^2 for ends that are far from the middle of the body's box in these directions (1e6 m, or
// 100 D^2 / wavelength, with D its diagonal, if that is more), row by row: row theta and phi of the receiver, column
// theta and phi of the transmitter. Directions are unit vectors from the body. Throws as scattered does.
std::array<double, 4> cross_sections_m2(const Body& body, glm::dvec3 to_transmitter, glm::dvec3 to_receiver,
                                        double frequency_hz, const PhysicalOptics& options = {});

}  // namespace wavetracer
