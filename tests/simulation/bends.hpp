// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of diffraction: small scenes with edges, and paths matched with those of brute force by their
// interactions and the numbers of their surfaces and wedges. Coordinates are generic: no path runs through a corner.
#pragma once
#include <map>
#include <set>
#include <tuple>

#include "reference/brute_force.hpp"
#include "simulation/drive.hpp"

namespace wavetracer::test {

inline std::vector<Quad> operator+(std::vector<Quad> a, const std::vector<Quad>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Walls and roof over the corners of a plan (anticlockwise) whose roof is the listed quads of corner numbers.
inline std::vector<Quad> house(const std::vector<glm::dvec2>& plan, double height,
                               const std::vector<std::array<size_t, 4>>& roof) {
  std::vector<Quad> quads;
  const auto at = [&](size_t i, double z) { return glm::dvec3{plan[i % plan.size()].x, plan[i % plan.size()].y, z}; };
  for (size_t i = 0; i < plan.size(); ++i) quads.push_back({at(i, 0), at(i + 1, 0) - at(i, 0), {0, 0, height}});
  for (const auto& r : roof)
    quads.push_back({at(r[0], height), at(r[1], height) - at(r[0], height), at(r[3], height) - at(r[0], height)});
  return quads;
}

// A box that stands on z = 0, turned about the vertical.
inline std::vector<Quad> turned_box(const glm::dvec2& corner, double turn, double width, double depth, double height) {
  const glm::dvec2 u{width * std::cos(turn), width * std::sin(turn)},
      v{-depth * std::sin(turn), depth * std::cos(turn)};
  return house({corner, corner + u, corner + u + v, corner + v}, height, {{0, 1, 2, 3}});
}

inline const std::vector<Quad> ground{{{-40, -35, 0}, {80, 0, 0}, {0, 70, 0}}};

// Two screens and a panel aloft, all their edges free.
inline std::vector<Quad> screens() {
  return ground + std::vector<Quad>{{{-4, -6.1, 0.7}, {0.4, 11, 0.1}, {0.1, 0, 4.3}},
                                    {{5, -4.2, 1.1}, {-0.7, 9.4, 0.2}, {0.2, 0.3, 3.1}},
                                    {{-1.7, -2.3, 6.3}, {3.6, 0.3, 0.5}, {-0.2, 4.1, 0.9}}};
}

inline std::vector<Quad> two_boxes() {
  return ground + turned_box({-6.2, -3.1}, 0.21, 4.3, 5.7, 5.2) + turned_box({4.1, -1.7}, -0.13, 3.9, 4.6, 3.3);
}

// Six walls, one of them seen through the notch, and a roof of two pieces that meet in a T; a panel stands beside it.
inline std::vector<Quad> l_shaped() {
  return ground +
         house({{-7.1, -4.2}, {5.3, -4.2}, {5.3, 1.1}, {-1.4, 1.1}, {-1.4, 7.7}, {-7.1, 7.7}, {-7.1, 1.1}}, 4.7,
               {{0, 1, 2, 6}, {6, 3, 4, 5}}) +
         std::vector<Quad>{{{3.3, 9.2, 0}, {7.1, -2.4, 0}, {0, 0, 3.9}}};
}

inline Points operator-(Points points, const glm::dvec3& by) {
  for (glm::dvec3& p : points) p -= by;
  return points;
}

// Ends, then interactions with the numbers of their surfaces and wedges.
using PathKey = std::tuple<uint32_t, uint32_t, std::vector<uint8_t>, std::vector<uint32_t>>;

template <class T>
std::vector<T> part(const std::vector<T>& column, uint64_t first, uint64_t end) {
  return {column.begin() + static_cast<ptrdiff_t>(first), column.begin() + static_cast<ptrdiff_t>(end)};
}

inline std::map<PathKey, Points> by_key(const PathGeometry& paths, const glm::dvec3& origin) {
  std::map<PathKey, Points> out;
  for (size_t i = 0; i < paths.size(); ++i) {
    const uint64_t first = paths.first[i], end = paths.first[i + 1];
    out[{paths.tx[i], paths.rx[i], part(paths.interaction, first, end), part(paths.surface, first, end)}] =
        part(paths.vertex, first, end) - (-origin);
  }
  return out;
}

inline std::map<PathKey, Points> by_key(const Paths& paths) {
  std::map<PathKey, Points> out;
  for (size_t i = 0; i < paths.size(); ++i) {
    const uint64_t first = paths.vertex_offset[i], end = paths.vertex_offset[i + 1];
    CHECK(out.emplace(PathKey{paths.tx[i], paths.rx[i], part(paths.vertex_interaction, first, end),
                              part(paths.vertex_surface, first, end)},
                      part(paths.vertex_position_m, first, end))
              .second);
  }
  return out;
}

inline std::string to_string(const PathKey& key) {
  std::string out = fmt::format("tx {} rx {}:", std::get<0>(key), std::get<1>(key));
  for (size_t k = 0; k < std::get<2>(key).size(); ++k)
    out += fmt::format(" {}{}", " RS T   D"[std::get<2>(key)[k]], std::get<3>(key)[k]);
  return out;
}

inline bool has(const PathKey& key, Interaction kind) { return std::ranges::count(std::get<2>(key), kind) > 0; }

inline TraceConfig diffracting(uint64_t rays, uint32_t max_depth) {
  TraceConfig trace;
  trace.rays = trace.diffraction_rays = rays;
  trace.max_depth = max_depth;
  trace.diffraction = true;
  return trace;
}

// Two masts, a station and a receiver over two boxes, and a grid of receivers around them, with diffraction.
inline Config map_over_boxes(const SceneFile& file, uint64_t rays, uint32_t max_depth, double step_m) {
  Config config = config_of(file.path(), {{-11, 3, 7}, {9, -8, 4}}, {{0.3, 4, 1}}, rays, max_depth);
  config.trace = diffracting(rays, max_depth);
  config.stations.resize(1);
  config.stations[0].name = "rsu";
  config.stations[0].position_m = {1.1, -7.3, 2};
  ReceiverGridConfig& grid = config.receiver_grids.emplace_back();
  grid.name = "g";
  grid.x_min_m = grid.y_min_m = -15;
  grid.x_max_m = 15;
  grid.y_max_m = 18;
  grid.step_m = step_m;
  return config;
}

// Checks that the paths of a frame are exactly those that exist, at the same places. Returns how many of them diffract.
inline size_t check_complete(const std::filesystem::path& scene_file, const Points& transmitters,
                             const Points& receivers, const TraceConfig& trace) {
  Config config = config_of(scene_file, transmitters, receivers, trace.rays, trace.max_depth);
  config.trace = trace;
  Simulation simulation(config);
  const auto found = by_key(simulation.run_frame(0).paths);
  const glm::dvec3& origin = simulation.scene().origin_m;
  const auto expected = by_key(reference::brute_force_all(simulation.scene(), transmitters - origin, receivers - origin,
                                                          {.max_depth = trace.max_depth,
                                                           .reflection = trace.reflection,
                                                           .transmission = trace.transmission,
                                                           .max_transmissions = trace.max_transmissions,
                                                           .diffraction = trace.diffraction,
                                                           .max_diffractions = trace.max_diffractions,
                                                           .free_edges = trace.free_edges}),
                               origin);
  size_t diffracted = 0;
  double apart_m = 0;
  for (const auto& [key, points] : expected) {
    CAPTURE(to_string(key));
    const auto match = found.find(key);
    CHECK_MESSAGE(match != found.end(), "not found");
    if (match == found.end()) continue;
    diffracted += has(key, diffraction);
    for (size_t k = 0; k < points.size(); ++k) apart_m = std::max(apart_m, glm::distance(points[k], match->second[k]));
  }
  for (const auto& entry : found) {
    CAPTURE(to_string(entry.first));
    CHECK_MESSAGE(expected.contains(entry.first), "no path");
  }
  CHECK(apart_m < 1e-6);
  return diffracted;
}

}  // namespace wavetracer::test
