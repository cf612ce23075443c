// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of the world: FCD files of vehicles whose centres move on circles and lines known exactly, and
// configurations that drive them.
#pragma once
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include "check_contains.hpp"
#include "motion/pose.hpp"
#include "scene/scene_files.hpp"
#include "simulation/world.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::test {

constexpr double pi = std::numbers::pi;

inline Scene static_scene() {
  Scene scene;
  scene.origin_m = {100, -50, 2};
  scene.surfaces.resize(7);
  return scene;
}

inline void check_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  CAPTURE(a.x);
  CAPTURE(a.y);
  CAPTURE(a.z);
  CAPTURE(b.x);
  CAPTURE(b.y);
  CAPTURE(b.z);
  CHECK(glm::distance(a, b) <= tolerance);
}

template <class E>
inline std::string error_of(const Config& config) {
  try {
    const World world = make_world(config, static_scene());
  } catch (const E& e) {
    return e.what();
  }
  return "no error";
}

// "turner" (passenger, 4.6 m long) drives a circle of 20 m at 10 m/s, counter-clockwise; "truck1" (truck, 7.1 m) along
// +x at 15 m/s, and is there from 0.5 s to 1.5 s only. Both are at 2 m height; 0.1 s between samples.
constexpr double radius_m = 20, speed_m_s = 10, rate_rad_s = speed_m_s / radius_m;

inline double turner_yaw(double time_s) { return pi / 2 + rate_rad_s * time_s; }
inline glm::dvec3 turner_centre(double time_s) {
  return {radius_m * std::cos(rate_rad_s * time_s), radius_m * std::sin(rate_rad_s * time_s), 2};
}
inline glm::dvec3 truck_centre(double time_s) { return {15 * time_s, 30, 2}; }

inline std::string vehicle(const std::string& id, const std::string& type, const glm::dvec3& centre, double yaw_rad,
                           double speed, double length_m) {
  return fmt::format(
      "<vehicle id=\"{}\" type=\"{}\" x=\"{:.17g}\" y=\"{:.17g}\" z=\"{:.17g}\" angle=\"{:.17g}\" "
      "speed=\"{}\" slope=\"0\"/>",
      id, type, centre.x + length_m / 2 * std::cos(yaw_rad), centre.y + length_m / 2 * std::sin(yaw_rad), centre.z,
      90 - yaw_rad * 180 / pi, speed);
}

inline std::string two_vehicles(const std::string& truck_type = "truck") {
  std::string out = "<fcd-export>\n";
  for (int k = 0; k <= 20; ++k) {
    const double time_s = 0.1 * k;
    out += fmt::format("<timestep time=\"{:.1f}\">", time_s);
    out += vehicle("turner", "passenger", turner_centre(time_s), turner_yaw(time_s), speed_m_s, 4.6);
    if (k >= 5 && k <= 15) out += vehicle("truck1", truck_type, truck_centre(time_s), 0, 15, 7.1);
    out += "</timestep>\n";
  }
  return out + "</fcd-export>\n";
}

inline MountConfig mount(const std::string& name, const std::string& on, MountRole role,
                         std::array<double, 3> offset_m) {
  MountConfig out;
  out.name = name;
  out.on = on;
  out.role = role;
  out.offset_m = offset_m;
  return out;
}

inline RadioEnd end(const std::string& name, std::array<double, 3> position_m) {
  RadioEnd out;
  out.name = name;
  out.position_m = position_m;
  return out;
}

inline Config drive(const TemporaryFolder& folder, const std::string& fcd = two_vehicles()) {
  Config config;
  config.trajectories.file = folder.write("drive.fcd.xml", fcd).string();
  config.vehicle_types.push_back({.name = "passenger", .length_m = 4.6});
  config.transmitters = {end("rsu", {0, 0, 6})};
  config.mounts = {mount("roof", "*", "both", {-0.5, 0.25, 1.6})};
  return config;
}

// The placed model, in the axes of a vehicle that stands at `centre` (scene coordinates) with this yaw.
struct Extent {
  glm::dvec3 lower{1e9}, upper{-1e9};
};
inline Extent extent_of(const Scene& model, const Placement& placed, const glm::dvec3& centre, double yaw_rad) {
  Extent out;
  for (const glm::dvec3& vertex : model.vertices) {
    const glm::dvec3 p = placed.position_m + placed.rotation * vertex - centre;
    const glm::dvec3 own(std::cos(yaw_rad) * p.x + std::sin(yaw_rad) * p.y,
                         -std::sin(yaw_rad) * p.x + std::cos(yaw_rad) * p.y, p.z);
    out.lower = glm::min(out.lower, own);
    out.upper = glm::max(out.upper, own);
  }
  return out;
}

}  // namespace wavetracer::test
