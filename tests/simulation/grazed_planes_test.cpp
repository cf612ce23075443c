// SPDX-License-Identifier: Apache-2.0
// Antennas that go through the plane of a roof or a wall, beyond its edges: their field has no step there.
#include <complex>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <numbers>
#include <optional>

#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Complex = std::complex<double>;

constexpr double frequency_hz = 1e9, light_m_s = 299792458.0;
// Steps in units of the field in free space; besides, the field changes by less than this for each metre of height.
constexpr double largest_step = 1e-3, largest_slope_per_m = 1;

// Makes a block of 4.5 m between x = 15 and 19.5, whose roof is at z = 0; everything else of it is far away.
std::vector<Quad> block_of(const glm::dmat4& place) {
  std::vector<Quad> quads = reference::box_walls({15, -90, -90}, {19.5, 90, 0});
  for (Quad& q : quads)
    q = {glm::dvec3(place * glm::dvec4(q.corner, 1)), glm::dmat3(place) * q.u, glm::dmat3(place) * q.v};
  return quads;
}

// The fields of both waves over that in free space, from a transmitter at one height to a receiver at each other one.
// Heights are over the plane; heights of the transmitter are the receivers' own where it has none.
std::array<Complex, 2> field_at(const std::string& material, const glm::dmat4& place, double from_m, double to_m) {
  const SceneFile file({{block_of(place), material}});
  const glm::dvec3 from(place * glm::dvec4(0, 0, from_m, 1)), to(place * glm::dvec4(34.5, 0, to_m, 1));
  Config config = config_of(file.path(), {from}, {to}, 100000, 3);
  config.radio.frequency_hz = frequency_hz;
  config.transmitters[0].polarization = config.receivers[0].polarization = "VH";
  config.trace = diffracting(100000, 3);
  config.trace.max_diffractions = 2;
  const Paths paths = run(config).paths;
  const double distance_m = glm::length(to - from);
  std::array<Complex, 2> sum{};
  for (size_t i = 0; i < paths.size(); ++i) {
    // Waves around the far sides of the block are left out.
    if (paths.delay_s[i] * light_m_s > distance_m + 1) continue;
    const double phase = -2 * std::numbers::pi * frequency_hz * (paths.delay_s[i] - distance_m / light_m_s);
    const Complex scale = std::polar(4 * std::numbers::pi * distance_m * frequency_hz / light_m_s, phase);
    for (size_t port = 0; port < 2; ++port) sum[port] += paths.a[i][3 * port] * scale;
  }
  return sum;
}

// Goes through the plane from above: the receiver, and where `other_m` is nothing, the transmitter with it.
void check_through(const std::string& material, const glm::dmat4& place, std::optional<double> other_m) {
  std::optional<std::array<Complex, 2>> last;
  double last_m = 0;
  for (const double height_m : {0.02, 9e-5, 1e-6, 0.0, -1e-6, -9e-5, -0.02}) {
    CAPTURE(height_m);
    const std::array<Complex, 2> field = field_at(material, place, other_m.value_or(height_m), height_m);
    for (size_t port = 0; port < 2; ++port) {
      CAPTURE(port);
      CHECK(std::abs(field[port]) > 0.05);
      if (last) CHECK(std::abs(field[port] - (*last)[port]) < largest_step + largest_slope_per_m * (last_m - height_m));
    }
    last = field;
    last_m = height_m;
  }
}

}  // namespace

TEST_CASE("both ends go through the plane of a roof together, or one alone while the other is above or below") {
  for (const std::string material : {"metal", "concrete"})
    for (const std::optional<double> other_m : {std::optional<double>(), {0.5}, {-0.5}}) {
      CAPTURE(material);
      CAPTURE(other_m.value_or(0));
      check_through(material, glm::dmat4(1), other_m);
    }
}

TEST_CASE("the same through the plane of a house's wall") {
  const glm::dmat4 upright = glm::rotate(glm::dmat4(1), std::numbers::pi / 2, glm::dvec3(1, 0, 0));
  for (const std::string material : {"metal", "concrete"})
    for (const std::optional<double> other_m : {std::optional<double>(), {-0.5}}) {
      CAPTURE(material);
      CAPTURE(other_m.value_or(0));
      check_through(material, upright, other_m);
    }
}
