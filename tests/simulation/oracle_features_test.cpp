// SPDX-License-Identifier: Apache-2.0
// Compares whole frames with diffraction and transmission with the reference path lists: every path, no path twice,
// gains. Gains of diffracted paths are only printed: the lists weight the terms of a wedge differently, neither
// continuously nor reciprocally (tests/radio/utd_oracle_test.cpp).
#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "folders.hpp"
#include "reference/compare.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi;
const std::filesystem::path project = test::source_folder(), shared = test::shared_folder();

Config config_for(const reference::Case& list, const std::filesystem::path& scenes) {
  Config config = config_of(scenes / list.scene / (list.scene + ".xml"), list.transmitters_m, list.receivers_m, 1000000,
                            list.max_depth);
  config.radio.frequency_hz = list.frequency_hz;
  config.trace.reflection = list.reflection;
  config.trace.transmission = list.transmission;
  config.trace.diffraction = list.diffraction;
  return config;
}

reference::Comparison compare(const reference::Case& list, const Paths& paths) {
  const reference::Comparison result = reference::compare_paths(list, paths);
  MESSAGE(list.name << ": " << reference::to_string(result));
  CHECK(result.duplicates == 0);
  CHECK(duplicates(paths) == 0);
  CHECK(result.delay_rel_err_max < 2e-6);
  for (const char* kind : {"specular", "transmission"})
    if (const auto found = result.kinds.find(kind); found != result.kinds.end() && found->second.found > 0)
      CHECK(found->second.gain_err_db_max <= 0.1);
  return result;
}

// The list of ../shared, where it and its scene are there.
std::optional<reference::Case> munich(const std::string& name) {
  const std::filesystem::path list = shared / "oracle" / (name + ".json");
  if (std::filesystem::exists(list) && std::filesystem::exists(shared / "scenes" / "munich"))
    return reference::load_case(list);
  MESSAGE("skipped: no " << list.string() << " (set WAVETRACER_SHARED)");
  return std::nullopt;
}

// A diffraction of a listed path: its point, and the vertices before and after it. Recentred.
struct Bend {
  dvec3 before, point, after;
};

std::optional<Bend> bend_of(const reference::Case& list, size_t path, const dvec3& origin_m) {
  const Paths& paths = list.paths;
  std::vector<dvec3> points{list.transmitters_m[paths.tx[path]]};
  std::optional<size_t> at;
  for (size_t k = paths.vertex_offset[path]; k < paths.vertex_offset[path + 1]; ++k) {
    if (paths.vertex_interaction[k] == diffraction) at = points.size();
    points.push_back(paths.vertex_position_m[k]);
  }
  points.push_back(list.receivers_m[paths.rx[path]]);
  if (!at) return std::nullopt;
  return Bend{points[*at - 1] - origin_m, points[*at] - origin_m, points[*at + 1] - origin_m};
}

double distance_m(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 way = b - a;
  return glm::distance(p, a + way * std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0));
}

// Tells whether the point is on a wedge with more than least_rad of free space.
bool on_wedge(const Scene& scene, const dvec3& p, double within_m, double least_rad) {
  return std::ranges::any_of(scene.wedges, [&](const Wedge& w) {
    return w.exterior_rad > least_rad && distance_m(p, w.start, w.start + w.along * w.length_m) <= within_m;
  });
}

std::array<dvec3, 3> corners(const Scene& scene, size_t triangle) {
  const auto& [a, b, c] = scene.triangles[triangle];
  return {scene.vertices[a], scene.vertices[b], scene.vertices[c]};
}

// The side of a triangle at which a path bends: within 3 cm of its point, the one that best keeps Keller's law, the
// same angle to the edge before and after. The list's points are off by a centimetre, which turns short legs.
std::optional<std::array<dvec3, 2>> edge_at(const Scene& scene, const Bend& bend) {
  std::optional<std::array<dvec3, 2>> best;
  double least = 1e-3 + 0.01 / std::min(glm::distance(bend.point, bend.before), glm::distance(bend.point, bend.after));
  const dvec3 in = glm::normalize(bend.point - bend.before), out = glm::normalize(bend.after - bend.point);
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto corner = corners(scene, t);
    for (size_t k = 0; k < 3; ++k) {
      const dvec3 &a = corner[k], &b = corner[(k + 1) % 3];
      if (distance_m(bend.point, a, b) > 0.03) continue;
      const double off = std::abs(glm::dot(in - out, glm::normalize(b - a)));
      if (off < least) best = {a, b}, least = off;
    }
  }
  return best;
}

// The widest sector about an edge that no triangle enters, of all triangles that pass within 1 cm of the edge beside
// `point`: each whose plane holds the edge takes the azimuths in which it is still there 5 cm away.
double widest_sector_rad(const Scene& scene, const std::array<dvec3, 2>& edge, const dvec3& point) {
  const dvec3 along = glm::normalize(edge[1] - edge[0]);
  const dvec3 on_edge = edge[0] + along * glm::dot(point - edge[0], along);
  const dvec3 zero = glm::normalize(glm::cross(along, std::abs(along.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  std::vector<double> azimuths;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto corner = corners(scene, t);
    const dvec3 area = glm::cross(corner[1] - corner[0], corner[2] - corner[0]), normal = glm::normalize(area);
    if (std::abs(glm::dot(normal, along)) > 0.05 || std::abs(glm::dot(normal, on_edge - corner[0])) > 0.01) continue;
    for (const double sign : {1.0, -1.0}) {
      const dvec3 side = sign * glm::normalize(glm::cross(normal, along));
      const dvec3 probe = on_edge + 0.05 * side;
      bool inside = true;
      for (size_t k = 0; k < 3; ++k) {
        const dvec3 way = corner[(k + 1) % 3] - corner[k];
        inside &= glm::dot(glm::cross(way, probe - corner[k]), normal) >= -1e-6 * glm::length(way);
      }
      if (inside) azimuths.push_back(std::atan2(glm::dot(side, glm::cross(along, zero)), glm::dot(side, zero)));
    }
  }
  if (azimuths.empty()) return 2 * pi;
  std::ranges::sort(azimuths);
  double widest = azimuths.front() + 2 * pi - azimuths.back();
  for (size_t i = 1; i < azimuths.size(); ++i) widest = std::max(widest, azimuths[i] - azimuths[i - 1]);
  return widest;
}

}  // namespace

TEST_CASE("the small lists with diffraction and transmission: every path at the defaults") {
  for (const std::string name : {"simple_wedge", "floor_wall", "box_one_screen"})
    for (const DiscoveryWay discovery : {DiscoveryWay("rays"), DiscoveryWay("beams")}) {
      CAPTURE(name);
      CAPTURE(discovery == "beams");
      const reference::Case list = reference::load_case(project / "tests/reference/oracle" / (name + ".json"));
      Config config = config_for(list, project / "tests/reference/scenes");
      config.trace.discovery = discovery;
      CHECK(compare(list, run(config).paths).recall == 1);
    }
}

TEST_CASE("a street canyon with cars: every path of the list, and of its kinds") {
  const reference::Case list = reference::load_case(project / "tests/reference/oracle/street_canyon_cars_all.json");
  Config config = config_for(list, project / "tests/reference/scenes");
  config.trace.free_edges = false;  // as the list has it
  config.trace.diffraction_rays = 1000000;
  const reference::Comparison c = compare(list, run(config).paths);
  CHECK(c.recall == 1);
  CHECK(c.kinds.at("diffraction").reference > 250);
  CHECK(c.kinds.at("transmission + diffraction").found > 0);
  CHECK(c.kinds.at("specular").extra == 0);
  CHECK(c.kinds.at("transmission").extra_power_ratio < 1e-6);  // ours pass through metal, too, but without any power
}

TEST_CASE("munich, transmission: every path, no other") {
  const auto list = munich("munich_transmission");
  if (!list) return;
  for (const DiscoveryWay discovery : {DiscoveryWay("rays"), DiscoveryWay("beams")}) {
    CAPTURE(discovery == "beams");
    Config config = config_for(*list, shared / "scenes");
    config.trace.discovery = discovery;
    const reference::Comparison c = compare(*list, run(config).paths);
    CHECK(c.recall == 1);
    CHECK(c.extra == 0);
    CHECK(c.kinds.at("transmission").reference > 0);
  }
}

// If buildings touch, the list has two wedges, one for each mesh. The faces of both together leave no sector wider than
// 180 degrees, so there is nothing but a corner that could diffract, and those paths do not exist. All others must be
// found.
TEST_CASE("munich, diffraction: every path whose edge is one when all faces there are counted") {
  const auto list = munich("munich_diffraction");
  if (!list) return;
  Simulation simulation(config_for(*list, shared / "scenes"));
  const reference::Comparison c = compare(*list, simulation.run_frame(0).paths);
  const Scene& scene = simulation.scene();
  CHECK(c.kinds.at("specular").recall == 1);
  CHECK(c.kinds.at("diffraction").found >= 400);
  double widest_of_missing = 0, narrowest_of_found = 2 * pi;
  for (size_t path = 0; path < list->paths.size(); ++path) {
    const auto bend = bend_of(*list, path, scene.origin_m);
    if (!bend) continue;
    CAPTURE(reference::to_string(list->paths, path));
    const bool found = std::ranges::find(c.missing, path) == c.missing.end();
    // Corners and the slightest bends diffract, too, but not everywhere.
    CHECK(on_wedge(scene, bend->point, 0.03, found ? 0 : pi + 1e-3) == found);
    const auto edge = edge_at(scene, *bend);
    REQUIRE(edge);
    const double sector_rad = widest_sector_rad(scene, *edge, bend->point);
    if (found && on_wedge(scene, bend->point, 0.03, pi + 1e-3))
      narrowest_of_found = std::min(narrowest_of_found, sector_rad);
    else if (!found)
      widest_of_missing = std::max(widest_of_missing, sector_rad);
  }
  CHECK(widest_of_missing <= pi + 1e-3);
  CHECK(narrowest_of_found > pi + 1e-3);
  MESSAGE(c.missing.size() << " paths of the list bend where buildings touch; the widest sector there is "
                           << widest_of_missing * 180 / pi << " degrees, the narrowest of the others "
                           << narrowest_of_found * 180 / pi);
}
