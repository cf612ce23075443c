// SPDX-License-Identifier: Apache-2.0
// A world with a path of each kind, for tests of fields.
#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "passes/solved_rows.hpp"
#include "reference/quads.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/path_rows.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer::test {

inline constexpr double light_m_s = 299792458.0, frequency_hz = 5.9e9, carrier_wave_m = light_m_s / frequency_hz;
inline constexpr uint32_t most_steps = 3;
enum FieldSurface : uint32_t { ground, conducting_wall, screen };
inline constexpr uint32_t corner_wedge = 4;  // a wedge

// A ground of concrete without end below, a perfect conductor at y = 8, and a screen of concrete at x = 10, 3 m high,
// whose upper edge is wedge 2. Ground and conductor meet in a corner, the last wedge.
inline Scene ground_wall_and_screen() {
  const std::vector<reference::Quad> quads{{{-100, -100, 0}, {200, 0, 0}, {0, 200, 0}},
                                           {{-100, 8, 0}, {200, 0, 0}, {0, 0, 50}},
                                           {{10, -20, 0}, {0, 40, 0}, {0, 0, 3}}};
  Scene scene = reference::scene_of_quads(quads);
  const Material concrete{.name = "concrete", .a = 5.24, .c = 0.0462, .d = 0.7822};
  scene.materials.assign(3, concrete);
  scene.materials[ground].thickness_m = std::numeric_limits<double>::infinity();
  scene.materials[conducting_wall] = {.name = "conductor", .a = 1, .c = 1e35};
  for (uint32_t surface = 0; surface < 3; ++surface) scene.surfaces[surface].material = surface;
  scene.wedges = reference::free_wedges(quads[screen], screen);
  scene.wedges.push_back({.start = {100, 8, 0},
                          .along = {-1, 0, 0},
                          .length_m = 200,
                          .face = {0, -1, 0},
                          .normal = {0, 0, 1},
                          .exterior_rad = std::numbers::pi / 2,
                          .surface = {ground, conducting_wall},
                          .plane = {ground, conducting_wall}});
  scene.origin_m = {1000, 2000, 300};
  return scene;
}

inline PathRow field_row(const glm::dvec3& from, const glm::dvec3& to, const std::vector<uint32_t>& steps,
                         const std::vector<glm::dvec3>& points) {
  return {.from = from, .to = to, .steps = steps, .points = points};
}

// The world in which row i goes from transmitter i to receiver i. Velocities differ from end to end.
struct FieldWorld {
  Scene scene = ground_wall_and_screen();
  std::vector<PathRow> rows;
  Config config;
  WorldState state;

  FieldWorld(std::vector<PathRow> all, const std::string& antenna) : rows(std::move(all)) {
    config.radio.frequency_hz = frequency_hz;
    config.trace.max_depth = most_steps;
    config.trace.transmission = true;
    config.trace.diffraction = true;
    for (size_t i = 0; i < rows.size(); ++i) {
      const auto k = static_cast<double>(i);
      const RadioEnd end{.name = "end", .antenna = antenna, .polarization = "VH"};
      config.transmitters.push_back(end);
      config.receivers.push_back(end);
      state.transmitters.push_back({.position_m = rows[i].from, .velocity_m_s = {10 + k, -3, 0.5 * k}});
      state.receivers.push_back({.position_m = rows[i].to, .velocity_m_s = {-20, k, 1}});
    }
  }

  // The length of a row.
  double length_m(size_t i) const {
    double out = 0;
    glm::dvec3 at = rows[i].from;
    for (const glm::dvec3& point : rows[i].points) out += glm::distance(at, point), at = point;
    return out + glm::distance(at, rows[i].to);
  }
};

// One path of each kind: in sight, reflected by the ground, by the wall and by both, through the screen, over it, and
// past the corner, at whose edge both legs make one angle.
inline std::vector<PathRow> path_of_each_kind() {
  const double from_corner_m = std::hypot(4, 2), to_corner_m = std::hypot(6, 4);
  const double corner_x = -30 + 24 * from_corner_m / (from_corner_m + to_corner_m);
  return {field_row({-30, 0, 2}, {6, 0, 5}, {}, {}),
          field_row({-30, 0, 2}, {-6, 0, 4}, {WT_STEP_REFLECTION | ground}, {{-22, 0, 0}}),
          field_row({-30, 4, 2}, {-6, 2, 2}, {WT_STEP_REFLECTION | conducting_wall}, {{-20.4, 8, 2}}),
          field_row({-30, 4, 2}, {-6, 2, 4}, {WT_STEP_REFLECTION | ground, WT_STEP_REFLECTION | conducting_wall},
                    {{-22, 22.0 / 3, 0}, {-20.4, 8, 0.4}}),
          field_row({0, 0, 2}, {20, 0, 2}, {WT_STEP_TRANSMISSION | screen}, {{10, 0, 2}}),
          field_row({0, 0, 2}, {20, 0, 2}, {WT_STEP_DIFFRACTION | 2}, {{10, 0, 3}}),
          field_row({-30, 4, 2}, {-6, 2, 4}, {WT_STEP_DIFFRACTION | corner_wedge}, {{corner_x, 8, 0}})};
}

}  // namespace wavetracer::test
