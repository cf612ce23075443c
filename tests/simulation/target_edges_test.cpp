// SPDX-License-Identifier: Apache-2.0
// Paths over targets with an edge before them or after them: each is the product of two ways that frames without a
// target compute, between an antenna and one in the place of the point; and there is one for each pair of ways.
#include <map>
#include <numbers>
#include <set>

#include "simulation/bends.hpp"
#include "simulation/radar_world.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

using Matrix = std::array<std::complex<double>, 4>;  // receiver's port 2 r + transmitter's port t

// A way between an antenna and the point, or a path: its interactions as letters, surfaces and all, and its field.
struct Way {
  std::string kinds, steps;
  double delay_s;
  Matrix a;
  long edges() const { return std::ranges::count(kinds, 'D'); }
};

std::vector<Way> ways_of(const Paths& paths) {
  std::vector<Way> out;
  for (size_t i = 0; i < paths.size(); ++i) {
    Way way{{}, {}, paths.delay_s[i], paths.a[i]};
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
      way.kinds += paths.vertex_interaction[k] == target_point  ? 'T'
                   : paths.vertex_interaction[k] == diffraction ? 'D'
                                                                : 'R';
      way.steps += fmt::format("{}{} ", way.kinds.back(), paths.vertex_surface[k]);
    }
    out.push_back(way);
  }
  return out;
}

// to * from, as matrices.
Matrix product(const Matrix& to, const Matrix& from, double scale) {
  Matrix out;
  for (int r = 0; r < 2; ++r)
    for (int t = 0; t < 2; ++t) out[2 * r + t] = (to[2 * r] * from[t] + to[2 * r + 1] * from[2 + t]) * scale;
  return out;
}

Config edges_config(const SceneFile& file, const dvec3& from, const dvec3& to, uint32_t depth, uint32_t edges) {
  Config config = radar_world(file, {from}, {to}, depth);
  config.trace.diffraction = true;
  config.trace.max_diffractions = edges;
  return config;
}

// All pairs of ways over the point, by their steps. Edges are next to the point.
std::map<std::string, Way> pairs_of_ways(const SceneFile& file, const dvec3& from, const dvec3& to, const dvec3& point,
                                         double section_m2, uint32_t interactions, long edges) {
  std::map<std::string, Way> out;
  const auto before = ways_of(run(edges_config(file, from, point, interactions, 1)).paths);
  const auto after = ways_of(run(edges_config(file, point, to, interactions, 1)).paths);
  for (const Way& a : before)
    for (const Way& b : after) {
      if ((a.edges() > 0 && a.kinds.back() != 'D') || (b.edges() > 0 && b.kinds.front() != 'D')) continue;
      if (a.edges() + b.edges() > edges) continue;
      out[a.steps + "T0 " + b.steps] = {
          a.kinds + "T" + b.kinds,
          {},
          a.delay_s + b.delay_s,
          product(b.a, a.a, std::sqrt(4 * std::numbers::pi * section_m2) / radar_wavelength_m)};
    }
  return out;
}

double size_of(const Matrix& a) {
  double sum = 0;
  for (const auto& x : a) sum += std::norm(x);
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("edges beside a target: every pair of ways, and its field is the product of theirs") {
  const dvec3 from{-11.3, -5.7, 1.6}, to{11.9, 3.3, 1.9}, point{-1.5, 4.2, 1.3};
  TargetModelConfig model;
  model.rcs_dbsm = {4};
  const double section_m2 = std::pow(10, 0.4);
  for (const std::vector<Quad>& quads : {two_boxes(), screens()}) {
    const SceneFile file(quads);
    for (const uint32_t edges : {1u, 2u}) {
      CAPTURE(edges);
      Config config = edges_config(file, from, to, 5, edges);
      add_target(config, model, point);
      config.trace.target_reflections = 2;
      config.trace.target_diffraction = true;
      const Paths paths = run(config).paths;
      const auto expected = pairs_of_ways(file, from, to, point, section_m2, 2, edges);
      size_t echoes = 0, before = 0, after = 0, both = 0;
      for (const Way& way : ways_of(paths)) {
        const size_t at = way.kinds.find('T');
        if (at == std::string::npos) continue;
        ++echoes;
        CAPTURE(way.steps);
        const auto found = expected.find(way.steps);
        REQUIRE(found != expected.end());
        CHECK(std::abs(way.delay_s / found->second.delay_s - 1) < 1e-12);
        Matrix apart = way.a;
        for (int i = 0; i < 4; ++i) apart[i] -= found->second.a[i];
        CHECK(size_of(apart) < 1e-9 * size_of(found->second.a));
        before += way.kinds.find('D') < at;
        after += way.kinds.rfind('D') != std::string::npos && way.kinds.rfind('D') > at;
        both += way.edges() == 2;
      }
      CHECK(echoes == expected.size());
      CHECK(before > 3);
      CHECK(after > 3);
      CHECK((edges == 2 ? both > 3 : both == 0));
      config.trace.target_diffraction = false;
      size_t fewer = 0;
      for (const Way& way : ways_of(run(config).paths)) {
        if (way.kinds.find('T') == std::string::npos) continue;
        ++fewer;
        CHECK(way.edges() == 0);
      }
      CHECK((fewer > 0 && fewer < echoes));
    }
  }
}

TEST_CASE("edges beside a target: the way back has the same paths, and rays find them too") {
  const dvec3 from{-11.3, -5.7, 1.6}, to{11.9, 3.3, 1.9}, point{-1.5, 4.2, 1.3};
  const SceneFile file(two_boxes());
  TargetModelConfig model;
  model.rcs_dbsm = {4};
  const auto echoes_of = [&](const dvec3& a, const dvec3& b, const char* discovery, bool ends) {
    Config config = edges_config(file, a, b, 3, 2);
    add_target(config, model, point);
    config.trace.target_reflections = 1;
    config.trace.target_diffraction = true;
    config.trace.edge_ends = ends;
    config.trace.discovery = DiscoveryWay::named(discovery);
    config.trace.rays = 200000;
    std::vector<std::pair<double, Matrix>> out;
    for (const Way& way : ways_of(run(config).paths))
      if (way.kinds.find('T') != std::string::npos) out.emplace_back(way.delay_s, way.a);
    std::ranges::sort(out, {}, [](const auto& row) { return row.first; });
    return out;
  };
  for (const bool ends : {false, true}) {
    const auto there = echoes_of(from, to, "beams", ends), back = echoes_of(to, from, "beams", ends);
    const auto sampled = echoes_of(from, to, "rays", ends);
    REQUIRE(there.size() > 8);
    REQUIRE(there.size() == back.size());
    CHECK(sampled.size() == there.size());
    for (size_t i = 0; i < there.size(); ++i) {
      const double size = size_of(there[i].second);
      CHECK(std::abs(there[i].first / back[i].first - 1) < 1e-12);
      for (const auto& [p, q] : {std::pair{0, 0}, {1, 2}, {2, 1}, {3, 3}})
        CHECK(std::abs(there[i].second[p] - back[i].second[q]) <= 1e-9 * size);
    }
  }
}

TEST_CASE("edges beside a target: the floor leaves out weaker paths alone") {
  const SceneFile file(two_boxes());
  Config config = edges_config(file, {-11.3, -5.7, 1.6}, {11.9, 3.3, 1.9}, 5, 2);
  TargetModelConfig model;
  model.rcs_dbsm = {4};
  add_target(config, model, {-1.5, 4.2, 1.3});
  config.trace.target_reflections = 2;
  config.trace.target_diffraction = true;
  std::vector<Way> all = ways_of(run(config).paths);
  std::erase_if(all, [](const Way& way) { return way.kinds.find('T') == std::string::npos; });
  std::ranges::sort(all, std::greater(), [](const Way& way) { return size_of(way.a); });
  REQUIRE(all.size() > 20);
  const auto left_above = [&](double floor_db) {
    config.trace.target_floor_db = floor_db;
    std::set<std::string> left;
    for (const Way& way : ways_of(run(config).paths))
      if (way.kinds.find('T') != std::string::npos) left.insert(way.steps);
    return left;
  };
  const double strongest_db = 20 * std::log10(size_of(all.front().a));
  const double third_db = 20 * std::log10(size_of(all[all.size() / 3].a));
  const std::set<std::string> left = left_above(third_db);
  // The gain of a path between any antennas is at most the sum of the squares of its matrix, and it is half of it for
  // some.
  size_t strong = 0;
  for (const Way& way : all) {
    if (20 * std::log10(size_of(way.a)) <= third_db + 3.01) continue;
    ++strong;
    CHECK(left.contains(way.steps));
  }
  CHECK(strong > 3);
  CHECK(left_above(strongest_db + 30).empty());
}
