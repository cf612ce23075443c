// SPDX-License-Identifier: Apache-2.0
// Vehicles whose bodies are targets, their echoes, and the same bodies alone.
#pragma once
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bodies/physical_optics.hpp"
#include "simulation/radar_world.hpp"

namespace wavetracer::test {

constexpr double body_hz = 10e9, body_wave_m = speed_of_light / body_hz;
inline const glm::dvec3 body_place(0, 0, 10);

using Channel = std::array<std::complex<double>, 4>;

// The six faces of a box, seen from outside.
inline std::vector<Quad> solid_box(const glm::dvec3& lower, const glm::dvec3& upper) {
  std::vector<Quad> out;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 a(0), b(0), c(0);
    a[axis] = upper[axis] - lower[axis];
    b[(axis + 1) % 3] = upper[(axis + 1) % 3] - lower[(axis + 1) % 3];
    c[(axis + 2) % 3] = upper[(axis + 2) % 3] - lower[(axis + 2) % 3];
    out.push_back({lower + a, b, c});
    out.push_back({lower, c, b});
  }
  return out;
}

inline const std::vector<Quad> one_box = solid_box({-0.3, -0.2, -0.15}, {0.3, 0.2, 0.15});
inline const std::vector<Quad> one_plate{{{0, -0.2, -0.15}, {0, 0.4, 0}, {0, 0, 0.3}}};  // it looks ahead

// A vehicle with this body, which drives along x past body_place at the beginning.
inline Config body_world(const SceneFile& scene, const SceneFile& body, const Points& from, const Points& to,
                         uint32_t max_depth = 1, bool flat = false) {
  Config config = radar_world(scene, from, to, max_depth);
  config.radio.frequency_hz = body_hz;
  config.vehicle_types = {{.name = "body", .model = (body.path().parent_path() / "part_0.ply").string()}};
  if (flat) {
    config.vehicle_types[0].length_m = 0.01;
    config.vehicle_types[0].width_m = 0.4;
    config.vehicle_types[0].height_m = 0.3;
  }
  config.tracks = {{.id = "a",
                    .type = "body",
                    .waypoints = {{0, body_place.x, body_place.y, body_place.z},
                                  {1, body_place.x + 5, body_place.y, body_place.z}}}};
  config.time = {0, 0, 1};
  TargetModelConfig model;
  model.name = "facets";
  model.on = "body";
  model.kind = "body";
  model.piece_m = 0.1;
  config.target_models = {model};
  return config;
}

// The sum of the echoes of a link.
inline Channel heard(const Paths& paths, uint32_t rx = 0) {
  Channel out{};
  for (const size_t i : echoes(paths))
    if (paths.rx[i] == rx)
      for (size_t k = 0; k < 4; ++k)
        out[k] += paths.a[i][k] * std::polar(1.0, -2 * std::numbers::pi * body_hz * paths.delay_s[i]);
  return out;
}

// The same of a body that stands alone.
inline Channel alone(const Body& body, const glm::dvec3& from, const glm::dvec3& to) {
  PhysicalOptics options;
  options.max_bounces = 1;
  options.reciprocal = true;
  options.phase_error_rad = 0.01;
  options.amplitude_error = 0.003;
  Channel out = sum_of(scattered(body, from - body_place, to - body_place, body_hz, options), body_hz);
  for (std::complex<double>& value : out) value *= body_wave_m / (4 * std::numbers::pi);
  return out;
}

// The largest difference over the largest entry of what is expected.
inline double difference(const Channel& found, const Channel& expected) {
  double most = 0, size = 0;
  for (size_t k = 0; k < 4; ++k) {
    most = std::max(most, std::abs(found[k] - expected[k]));
    size = std::max(size, std::abs(expected[k]));
  }
  return most / size;
}

inline glm::dvec3 direction(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * std::numbers::pi / 180, elevation = elevation_deg * std::numbers::pi / 180;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

constexpr double tenth_of_db = 0.0115;

}  // namespace wavetracer::test
