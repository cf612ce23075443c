// SPDX-License-Identifier: Apache-2.0
// Coefficients against the reference path lists: their sequences of surfaces, solved here and compared as matrices. The
// lists come from a float32 program: its points have errors of millimetres, which turns a leg of a few centimetres by
// degrees, and it evaluates fields at those directions. So fields are compared at its own points as well as at ours.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <utility>

#include "folders.hpp"
#include "radio/fields.hpp"
#include "radio/oracle_lists.hpp"
#include "radio/world.hpp"
#include "scene/load.hpp"

using namespace wavetracer;
using test::to_vector;
using Json = nlohmann::json;

namespace {

struct ReferencePath {
  uint32_t tx, rx;
  double delay_s;
  std::vector<uint8_t> interactions;
  std::vector<glm::dvec3> vertices;  // recentred
  std::array<std::complex<double>, 4> a;
  std::array<double, 4> angles_rad;  // AoD theta, phi, AoA theta, phi
};

// Diffraction (8) is not specular.
bool specular(const Json& path) {
  return std::ranges::none_of(path["interactions"], [](const Json& kind) { return kind == 8; });
}

ReferencePath read_path(const Json& json, const glm::dvec3& origin_m) {
  ReferencePath path{.tx = json["tx"],
                     .rx = json["rx"],
                     .delay_s = json["tau_s"],
                     .interactions = json["interactions"],
                     .vertices = {},
                     .a = {},
                     .angles_rad = {json["aod_theta_phi_rad"][0], json["aod_theta_phi_rad"][1],
                                    json["aoa_theta_phi_rad"][0], json["aoa_theta_phi_rad"][1]}};
  for (const Json& v : json["vertices_m"]) path.vertices.push_back(to_vector(v) - origin_m);
  for (size_t i = 0; i < 4; ++i) path.a[i] = {json["a_re"][i / 2][i % 2], json["a_im"][i / 2][i % 2]};
  return path;
}

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - a - t * along);
}

double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
  const bool inside = glm::dot(glm::cross(b - a, p - a), n) >= 0 && glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
                      glm::dot(glm::cross(a - c, p - c), n) >= 0;
  if (inside) return std::abs(glm::dot(p - a, n));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

// The surfaces within reach of a point, nearest first.
std::vector<uint32_t> surfaces_at(const Scene& scene, const glm::dvec3& p, double reach_m) {
  std::vector<std::pair<double, uint32_t>> found;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const Surface& surface = scene.surfaces[scene.triangle_surface[t]];
    if (std::abs(glm::dot(surface.normal, p) - surface.offset_m) > reach_m) continue;
    const auto& [a, b, c] = scene.triangles[t];
    const double away = distance_to_triangle(p, scene.vertices[a], scene.vertices[b], scene.vertices[c]);
    if (away <= reach_m) found.emplace_back(away, scene.triangle_surface[t]);
  }
  std::ranges::sort(found);
  std::vector<uint32_t> surfaces;
  for (const auto& [away, surface] : found) {
    if (std::ranges::find(surfaces, surface) == surfaces.end()) surfaces.push_back(surface);
  }
  return surfaces;
}

struct Solved {
  std::vector<uint32_t> surfaces;
  std::vector<glm::dvec3> vertices;
};

std::vector<double> leg_lengths_m(const glm::dvec3& tx, const std::vector<glm::dvec3>& vertices, const glm::dvec3& rx) {
  std::vector<double> lengths;
  glm::dvec3 from = tx;
  for (const glm::dvec3& v : vertices) lengths.push_back(glm::length(v - std::exchange(from, v)));
  lengths.push_back(glm::length(rx - from));
  return lengths;
}

// Tries the surfaces near each point, nearest first, until the solved path has the reference's delay and points.
bool solve(const Scene& scene, const glm::dvec3& tx, const glm::dvec3& rx, const ReferencePath& reference,
           const std::vector<std::vector<uint32_t>>& choices, Solved& solved) {
  const size_t depth = choices.size();
  std::vector<size_t> digit(depth, 0);
  while (true) {
    solved.surfaces.clear();
    for (size_t i = 0; i < depth; ++i) solved.surfaces.push_back(choices[i][digit[i]]);
    solved.vertices = test::specular_vertices(scene, tx, rx, solved.surfaces, reference.interactions);
    double away = 0;
    for (size_t i = 0; i < depth; ++i) away = std::max(away, glm::length(solved.vertices[i] - reference.vertices[i]));
    const std::vector<double> legs = leg_lengths_m(tx, solved.vertices, rx);
    const double delay_s = std::accumulate(legs.begin(), legs.end(), 0.0) / speed_of_light_m_s;
    if (away < 0.3 && std::abs(delay_s - reference.delay_s) < std::max(2e-6 * reference.delay_s, 30e-12)) return true;
    size_t i = 0;
    while (i < depth && ++digit[i] == choices[i].size()) digit[i++] = 0;
    if (i == depth) return false;
  }
}

// Errors of the gain (dB), and of the 2 x 2 matrix relative to its norm.
struct Errors {
  std::vector<double> gain_db, matrix;

  void add(const std::array<std::complex<double>, 4>& mine, const std::array<std::complex<double>, 4>& reference) {
    double power = 0, reference_power = 0, difference = 0;
    for (size_t i = 0; i < 4; ++i) {
      power += std::norm(mine[i]);
      reference_power += std::norm(reference[i]);
      difference += std::norm(mine[i] - reference[i]);
    }
    gain_db.push_back(std::abs(10 * std::log10(power / reference_power)));
    matrix.push_back(std::sqrt(difference / reference_power));
  }
};

struct Comparison {
  size_t paths = 0, unsolved = 0;
  Errors at_its_points, at_ours, at_ours_long_legs;  // the last: no leg is shorter than long_leg_m
  std::vector<double> angle_rad;
};

constexpr double long_leg_m = 2;

double percentile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[static_cast<size_t>(part * static_cast<double>(values.size() - 1))];
}

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

Comparison compare(const std::filesystem::path& case_file, const std::filesystem::path& scenes) {
  const Json reference = Json::parse(std::ifstream(case_file));
  const std::string name = reference["scene"];
  test::World world(reference["frequency_hz"]);
  world.scene = load_scene_file(scenes / name / (name + ".xml"), {}, {}, world.config.radio.frequency_hz);
  Comparison result;
  std::vector<ReferencePath> references;
  std::vector<bool> long_legs;
  for (const Json& json : reference["paths"]) {
    if (!specular(json)) continue;
    ++result.paths;
    const ReferencePath path = read_path(json, world.scene.origin_m);
    const RadioEnd transmitter = test::World::end(to_vector(reference["tx_m"][path.tx]), "isotropic", "VH");
    const RadioEnd receiver = test::World::end(to_vector(reference["rx_m"][path.rx]), "isotropic", "VH");
    const glm::dvec3 tx = world.place(transmitter), rx = world.place(receiver);
    std::vector<std::vector<uint32_t>> choices;
    for (const glm::dvec3& v : path.vertices) choices.push_back(surfaces_at(world.scene, v, 0.3));
    Solved solved;
    if (std::ranges::any_of(choices, [](const auto& c) { return c.empty(); }) ||
        !solve(world.scene, tx, rx, path, choices, solved)) {
      ++result.unsolved;
      continue;
    }
    // Each row is a link of its own, so that rows stay in this order and are computed at once.
    for (const std::vector<glm::dvec3>& vertices : {path.vertices, solved.vertices}) {
      const auto row = static_cast<uint32_t>(world.config.transmitters.size());
      world.config.transmitters.push_back(transmitter);
      world.config.receivers.push_back(receiver);
      world.add_path(row, row, solved.surfaces, path.interactions, vertices);
    }
    long_legs.push_back(std::ranges::min(leg_lengths_m(tx, solved.vertices, rx)) >= long_leg_m);
    references.push_back(path);
  }
  const Paths paths = world.paths();
  REQUIRE(paths.a.size() == 2 * references.size());
  for (size_t k = 0; k < references.size(); ++k) {
    const ReferencePath& path = references[k];
    const size_t mine = 2 * k + 1;  // the row at our points, behind the one at its points
    result.at_its_points.add(paths.a[mine - 1], path.a);
    result.at_ours.add(paths.a[mine], path.a);
    if (long_legs[k]) result.at_ours_long_legs.add(paths.a[mine], path.a);
    result.angle_rad.push_back(std::max({turn_between(paths.aod_theta_rad[mine], path.angles_rad[0]),
                                         turn_between(paths.aod_phi_rad[mine], path.angles_rad[1]),
                                         turn_between(paths.aoa_theta_rad[mine], path.angles_rad[2]),
                                         turn_between(paths.aoa_phi_rad[mine], path.angles_rad[3])}));
  }
  return result;
}

std::string summary(const Errors& errors) {
  if (errors.gain_db.empty()) return "no path";
  return fmt::format("{} paths, gain p50 {:.1e} p99 {:.1e} max {:.1e} dB, matrix p50 {:.1e} p99 {:.1e} max {:.1e}",
                     errors.gain_db.size(), percentile(errors.gain_db, 0.5), percentile(errors.gain_db, 0.99),
                     percentile(errors.gain_db, 1), percentile(errors.matrix, 0.5), percentile(errors.matrix, 0.99),
                     percentile(errors.matrix, 1));
}

}  // namespace

TEST_CASE("coefficients, delays and angles agree with the reference path lists") {
  const std::filesystem::path shared = test::shared_folder();
  const std::filesystem::path lists = shared / "oracle", scenes = shared / "scenes";
  if (!std::filesystem::is_directory(lists) || !std::filesystem::is_directory(scenes)) {
    MESSAGE("skipped: no reference path lists in " << shared.string() << " (set WAVETRACER_SHARED)");
    return;
  }
  for (const std::string name :
       {"simple_reflector", "double_reflector", "triple_reflector", "box_depth5", "box_one_screen", "floor_wall",
        "street_canyon_cars_specular", "street_canyon_cars_all", "munich_roof", "munich_street_0", "munich_street_1",
        "munich_street_2", "munich_street_deep", "munich_transmission"}) {
    CAPTURE(name);
    const Comparison c = compare(lists / (name + ".json"), scenes);
    MESSAGE(
        fmt::format("{} of {} paths solved\n  at its points: {}\n  at ours: {}\n  at ours, legs of {} m and more: {}",
                    c.paths - c.unsolved, c.paths, summary(c.at_its_points), summary(c.at_ours), long_leg_m,
                    summary(c.at_ours_long_legs)));
    CHECK(c.paths > 0);
    CHECK(c.unsolved == 0);
    CHECK(percentile(c.at_its_points.gain_db, 0.99) <= 0.02);
    CHECK(percentile(c.at_its_points.matrix, 0.99) <= 0.001);
    CHECK(percentile(c.at_ours.gain_db, 0.5) <= 0.002);
    if (!c.at_ours_long_legs.gain_db.empty()) CHECK(percentile(c.at_ours_long_legs.gain_db, 0.99) <= 0.02);
    CHECK(percentile(c.angle_rad, 1) <= 0.001);
  }
}
