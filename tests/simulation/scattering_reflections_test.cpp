// SPDX-License-Identifier: Apache-2.0
// Paths that scatter from a tile and are reflected before or after it: one mirror against the image of the antenna; the
// floor; lists that are too long; phases; the energy of a closed room. tile_chains_test.cpp searches all paths.
#include <cstdlib>
#include <map>
#include <numbers>

#include "simulation/rough_room.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

std::map<std::string, double> powers_by_kind(const Paths& paths) {
  std::map<std::string, double> out;
  for (size_t i = 0; i < paths.size(); ++i) {
    std::string kind;
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
      kind += paths.vertex_interaction[k] == scattering ? 'S' : 'R';
    out[kind] += std::pow(10, paths.gain_db[i] / 10);
  }
  return out;
}

class MostPoints {
 public:
  explicit MostPoints(const char* most) { setenv("WAVETRACER_MOST_POINTS", most, 1); }
  ~MostPoints() { unsetenv("WAVETRACER_MOST_POINTS"); }
};

}  // namespace

TEST_CASE("lists that are too long are made in parts, and the paths are the same to the last bit") {
  const SceneFile file(std::vector<Part>{{partitioned_room(), "concrete"}});
  const Config config = rough_room(file, room_from, room_to, 1);
  const Paths whole = run(config).paths;
  const MostPoints few("150");
  CHECK(identical(run(config).paths, whole));
}

TEST_CASE("0 reflections: what there was before, and no receiver launches rays") {
  const SceneFile file(std::vector<Part>{{partitioned_room(), "concrete"}});
  Config config = rough_room(file, room_from, room_to, 0);
  config.trace.discovery = "rays";
  const FrameResult frame = run(config);
  CHECK(frame.counts.rays == 2000);
  CHECK(frame.seconds.count("point_prefixes") == 0);
  for (const auto& [key, points] : scattered_paths(frame.paths)) CHECK(points.size() == 1);
  config.trace.scattering_reflections = 3;
  config.trace.max_depth = 1;
  CHECK(identical(run(config).paths, run(rough_room(file, room_from, room_to, 0)).paths) == false);
  CHECK(run(config).counts.rays == 2000);
}

TEST_CASE("a tile beside a perfect mirror: the paths of the images of both antennas") {
  MaterialConfig mirror, rough;
  mirror.name = "metal";
  mirror.permittivity = 1;
  mirror.conductivity_s_m = 1e18;
  rough.name = "concrete";
  rough.permittivity = 4;
  rough.conductivity_s_m = 0.01;
  rough.scattering = 0.7;
  rough.scattering_cross_polar = 0.2;
  const Part wall{{{{0, -40, -40}, {0, 80, 0}, {0, 0, 80}}}, "metal"};  // x = 0
  const Part plate{{{{6, 2, 1}, {0.5, 1.1, 0}, {0, 0.3, 0.9}}}, "concrete"};
  const dvec3 from{3.1, -1.2, 2.2}, to{2.4, 0.7, 5.3}, other_side{-1, 1, 1};
  for (const double lobe : {0.0, 3.0}) {
    rough.scattering_lobe = lobe;
    const auto config = [&](const SceneFile& file, const dvec3& tx, const dvec3& rx, uint32_t reflections) {
      Config out = rough_room(file, {tx}, {rx}, reflections);
      out.materials = {mirror, rough};
      return out;
    };
    const SceneFile both({wall, plate}), alone({plate});
    const auto powers = powers_by_kind(run(config(both, from, to, 1)).paths);
    const auto direct = [&](const dvec3& tx, const dvec3& rx) {
      return powers_by_kind(run(config(alone, tx, rx, 0)).paths).at("S");
    };
    CHECK(powers.at("S") == doctest::Approx(direct(from, to)).epsilon(1e-9));
    CHECK(powers.at("RS") == doctest::Approx(direct(from * other_side, to)).epsilon(1e-7));
    CHECK(powers.at("SR") == doctest::Approx(direct(from, to * other_side)).epsilon(1e-7));
    CHECK(powers.at("RSR") == doctest::Approx(direct(from * other_side, to * other_side)).epsilon(1e-7));
  }
}

TEST_CASE("chains over one tile have phases of their own; the way back and other frames have the same") {
  const SceneFile file(std::vector<Part>{{partitioned_room(), "concrete"}});
  const Config config = rough_room(file, room_from, {room_to[0]}, 1);
  const Paths paths = run(config).paths;
  // Coefficients lack the phase of the way. Mirrors turn a phase by nearly 0 or a half turn, which twice the phase does
  // not show.
  std::map<std::vector<double>, std::vector<double>> by_tile;
  for (size_t i = 0; i < paths.size(); ++i) {
    if (!scatters(paths, i) || paths.tx[i] != 0) continue;
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
      if (paths.vertex_interaction[k] == scattering) {
        const dvec3 p = paths.vertex_position_m[k];
        by_tile[{p.x, p.y, p.z}].push_back(std::arg(paths.a[i][0]));
      }
  }
  size_t shared = 0;
  std::complex<double> mean = 0;
  size_t pairs = 0;
  for (const auto& [tile, phases] : by_tile) {
    shared += phases.size() > 1;
    for (size_t i = 0; i < phases.size(); ++i)
      for (size_t j = i + 1; j < phases.size(); ++j, ++pairs) mean += std::polar(1.0, 2 * (phases[i] - phases[j]));
  }
  CHECK(shared > 20);
  CHECK(std::abs(mean) / static_cast<double>(pairs) < 4 / std::sqrt(static_cast<double>(pairs)));
  CHECK(identical(run(config).paths, paths));
}

TEST_CASE("the floor: every stronger path stays, and those that are left out are counted") {
  const SceneFile file(std::vector<Part>{{partitioned_room(), "concrete"}});
  Config config = rough_room(file, room_from, room_to, 2);
  const FrameResult all = run(config);
  CHECK(all.counts.weak == 0);
  const double floor_db = -98;
  config.trace.scattering_floor_db = floor_db;
  const FrameResult some = run(config);
  CHECK(some.counts.weak > 100);
  CHECK(some.paths.size() > 1000);
  CHECK(some.paths.size() + some.counts.weak <= all.paths.size());  // paths of weak halves are not counted
  Config in_batches = config;
  in_batches.trace.batch_receivers = 1;
  const FrameResult batches = run(in_batches);
  CHECK(identical(batches.paths, some.paths));
  const PathsOfTiles kept = scattered_paths(some.paths);
  for (size_t i = 0; i < all.paths.size(); ++i) {
    if (!scatters(all.paths, i) || all.paths.depth[i] == 1) continue;
    // Both antennas have two ports, so the gain between two that match is at most this.
    if (all.paths.gain_db[i] - 10 * std::log10(2.0) < floor_db) continue;
    Steps steps;
    for (uint64_t k = all.paths.vertex_offset[i]; k < all.paths.vertex_offset[i + 1]; ++k)
      steps.emplace_back(all.paths.vertex_interaction[k], all.paths.vertex_surface[k]);
    CHECK(kept.contains({all.paths.tx[i], all.paths.rx[i], steps}));
  }
}

// All waves that arrive at the walls after n interactions carry the power that was sent. Paths scatter once at most, so
// after n they are (1 - s)^n + n s (1 - s)^(n - 1) of it, with s = S^2.
TEST_CASE("energy of a closed room without losses: all but what would scatter twice") {
  constexpr double pi = std::numbers::pi, wavelength_m = speed_of_light / 5.9e9, share = 0.36;
  constexpr int along = 5;  // receivers along each side of a wall
  const dvec3 size{4.1, 3.3, 2.7};
  std::vector<Part> parts{{room_walls(size), "concrete"}};
  const SceneFile file(parts);
  Points receivers;
  std::vector<dvec3> normals;
  std::vector<double> areas;
  for (const Quad& wall : room_walls(size))
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < along; ++j) {
        dvec3 normal = glm::normalize(glm::cross(wall.u, wall.v));
        const dvec3 p = wall.corner + wall.u * ((i + 0.5) / along) + wall.v * ((j + 0.5) / along);
        if (glm::dot(normal, 0.5 * size - p) < 0) normal = -normal;
        receivers.push_back(p + 1e-3 * normal);
        normals.push_back(normal);
        areas.push_back(glm::length(glm::cross(wall.u, wall.v)) / (along * along));
      }
  Config config = rough_room(file, {{1.9, 1.4, 1.5}}, receivers, 1);
  config.trace.max_depth = 2;
  config.trace.tile_m = 1.0;
  config.transmitters[0].polarization = "V";
  config.materials[0].permittivity = 1;
  config.materials[0].conductivity_s_m = 1e18;
  config.materials[0].scattering = std::sqrt(share);
  const Paths paths = run(config).paths;
  std::array<double, 3> sums{};
  for (size_t i = 0; i < paths.size(); ++i) {
    const double theta = paths.aoa_theta_rad[i], phi = paths.aoa_phi_rad[i];
    const dvec3 in{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    const double cosine = std::max(glm::dot(in, normals[paths.rx[i]]), 0.0);
    sums[paths.depth[i]] += std::pow(10, paths.gain_db[i] / 10) * cosine * areas[paths.rx[i]];
  }
  for (double& sum : sums) sum *= 4 * pi / (wavelength_m * wavelength_m);
  CHECK(sums[0] == doctest::Approx(1).epsilon(0.015));  // the error of so few receivers, which later waves share
  CHECK(sums[1] / sums[0] == doctest::Approx(1).epsilon(0.005));
  CHECK(sums[2] / sums[0] == doctest::Approx((1 - share) * (1 - share) + 2 * share * (1 - share)).epsilon(0.005));
}
