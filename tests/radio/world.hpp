// SPDX-License-Identifier: Apache-2.0
// Small worlds for the tests of host/radio: planes, ends, and paths between them by the image method.
// Planes are endless and nothing is hidden: a test lists the sequences that it wants.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "radio/constants.hpp"
#include "radio/fields.hpp"

namespace wavetracer::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double radians = std::numbers::pi / 180;
inline constexpr double wavelength_m = speed_of_light_m_s / 5.9e9;  // at 5.9 GHz

// doctest's Approx adds 1 to the magnitude by default, which is useless for nanoseconds. This one is relative.
inline doctest::Approx near(double value, double relative) { return doctest::Approx(value).epsilon(relative).scale(0); }

// ITU-R P.2040-3, Table 3.
inline Material concrete(double thickness_m) { return {"concrete", 5.24, 0, 0.0462, 0.7822, 1, 100, thickness_m}; }
inline Material medium_dry_ground() { return {"medium_dry_ground", 15, -0.1, 0.035, 1.63, 1, 10, infinity}; }
// So good a conductor that 1 - |R| is below 1e-12: skin depth and loss go with 1 / sqrt(conductivity).
inline Material conductor() { return {"conductor", 1, 0, 1e35, 0, 0, infinity, infinity}; }

// The points of the path from tx to rx that meets these surfaces in turn, by the image method; all recentred.
inline std::vector<glm::dvec3> specular_vertices(const Scene& scene, const glm::dvec3& tx, const glm::dvec3& rx,
                                                 const std::vector<uint32_t>& surfaces,
                                                 const std::vector<uint8_t>& interactions) {
  const auto height = [&](size_t i, const glm::dvec3& p) {
    return glm::dot(p, scene.surfaces[surfaces[i]].normal) - scene.surfaces[surfaces[i]].offset_m;
  };
  std::vector<glm::dvec3> image{tx};
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const glm::dvec3 p = image.back();
    image.push_back(interactions[i] == reflection ? p - 2 * height(i, p) * scene.surfaces[surfaces[i]].normal : p);
  }
  std::vector<glm::dvec3> vertices(surfaces.size());
  glm::dvec3 target = rx;
  for (size_t i = surfaces.size(); i-- > 0;) {
    const double from = height(i, image[i + 1]), to = height(i, target);
    target = vertices[i] = image[i + 1] + from / (from - to) * (target - image[i + 1]);
  }
  return vertices;
}

struct World {
  Scene scene;
  Config config;
  PathGeometry geometry;

  explicit World(double frequency_hz = 5.9e9) { config.radio.frequency_hz = frequency_hz; }

  double wavelength_m() const { return speed_of_light_m_s / config.radio.frequency_hz; }

  uint32_t add_plane(const glm::dvec3& normal, const glm::dvec3& point, const Material& material) {
    Surface surface;
    surface.normal = glm::normalize(normal);
    surface.offset_m = glm::dot(surface.normal, point);
    surface.material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    scene.surfaces.push_back(surface);
    return static_cast<uint32_t>(scene.surfaces.size() - 1);
  }

  static RadioEnd end(const glm::dvec3& position, const std::string& antenna = "isotropic",
                      Polarization polarization = "V", const std::array<double, 3>& orientation_deg = {0, 0, 0}) {
    return {"end", {position.x, position.y, position.z}, antenna, polarization, orientation_deg};
  }

  // The path from tx to rx that is reflected by these surfaces in turn.
  void add_reflections(uint32_t tx, uint32_t rx, const std::vector<uint32_t>& surfaces) {
    const std::vector<uint8_t> interactions(surfaces.size(), reflection);
    add_path(
        tx, rx, surfaces, interactions,
        specular_vertices(scene, place(config.transmitters[tx]), place(config.receivers[rx]), surfaces, interactions));
  }

  // Recentred.
  glm::dvec3 place(const RadioEnd& e) const {
    return glm::dvec3{e.position_m[0], e.position_m[1], e.position_m[2]} - scene.origin_m;
  }

  void add_path(uint32_t tx, uint32_t rx, const std::vector<uint32_t>& surfaces,
                const std::vector<uint8_t>& interactions, const std::vector<glm::dvec3>& vertices) {
    geometry.tx.push_back(tx);
    geometry.rx.push_back(rx);
    geometry.surface.insert(geometry.surface.end(), surfaces.begin(), surfaces.end());
    geometry.interaction.insert(geometry.interaction.end(), interactions.begin(), interactions.end());
    geometry.vertex.insert(geometry.vertex.end(), vertices.begin(), vertices.end());
    geometry.first.push_back(geometry.surface.size());
  }

  Paths paths() const { return compute_paths(scene, config, 0, geometry); }

  // |h(f)|^2 in dB of single-port ends: sum of a exp(-j 2 pi f tau) at the carrier.
  double narrowband_gain_db() const {
    const Paths all = paths();
    std::complex<double> h = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      h += all.a[i][0] * std::polar(1.0, -2 * std::numbers::pi * config.radio.frequency_hz * all.delay_s[i]);
    }
    return 20 * std::log10(std::abs(h));
  }
};

}  // namespace wavetracer::test
