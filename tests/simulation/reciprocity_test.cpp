// SPDX-License-Identifier: Apache-2.0
// Tests reciprocity of every kind of path: with the ends exchanged the same path is found, of the same length, with its
// coefficients transposed. The antennas are directive, doubly polarised and turned, so that nothing is symmetric by
// chance.
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The letters of a path's interactions, sorted: "DR", "T", "" of a line of sight.
std::string kind_of(const PathKey& key) {
  std::string out;
  for (const uint8_t interaction : std::get<2>(key)) out += " RS T   D"[interaction];
  std::ranges::sort(out);
  return out;
}

std::map<PathKey, size_t> rows_by_key(const Paths& paths) {
  std::map<PathKey, size_t> out;
  for (size_t i = 0; i < paths.size(); ++i) {
    const uint64_t first = paths.vertex_offset[i], end = paths.vertex_offset[i + 1];
    out[{0, 0, part(paths.vertex_interaction, first, end), part(paths.vertex_surface, first, end)}] = i;
  }
  return out;
}

PathKey reversed(PathKey key) {
  std::ranges::reverse(std::get<2>(key));
  std::ranges::reverse(std::get<3>(key));
  return key;
}

RadioEnd antenna(const char* pattern, const glm::dvec3& at, const std::array<double, 3>& orientation_deg) {
  return {"antenna", {at.x, at.y, at.z}, pattern, "VH", orientation_deg};
}

using Kinds = std::map<std::string, size_t>;  // paths of each

// Checks every path of the configuration against the way back.
Kinds exchange(Config config, double most_error = 1e-9) {
  const Paths there = run(config).paths;
  std::swap(config.transmitters, config.receivers);
  const Paths back = run(config).paths;
  CHECK(there.size() == back.size());
  const std::map<PathKey, size_t> others = rows_by_key(back);
  Kinds out;
  for (const auto& [key, i] : rows_by_key(there)) {
    CAPTURE(to_string(key));
    const auto match = others.find(reversed(key));
    CHECK_MESSAGE(match != others.end(), "no way back");
    if (match == others.end()) continue;
    const size_t j = match->second;
    double size = 0, error = 0;
    for (size_t r = 0; r < 2; ++r)
      for (size_t t = 0; t < 2; ++t) {
        size += std::norm(there.a[i][2 * r + t]);
        error += std::norm(there.a[i][2 * r + t] - back.a[j][2 * t + r]);
      }
    const double relative = std::sqrt(error / size);
    CHECK(relative < most_error);
    CHECK(std::abs(there.delay_s[i] / back.delay_s[j] - 1) < 1e-12);
    ++out[kind_of(key)];
  }
  return out;
}

Config everything(const SceneFile& file, const glm::dvec3& from, const glm::dvec3& to) {
  Config config;
  config.scene.file = file.path().string();
  config.radio.frequency_hz = 3.5e9;
  config.transmitters = {antenna("tr38901", from, {31, 17, -23})};
  config.receivers = {antenna("dipole", to, {-112, 9, 41})};
  config.trace = diffracting(400000, 3);
  config.trace.transmission = config.trace.scattering = true;
  config.trace.max_diffractions = 2;
  config.trace.tile_m = 3;
  for (const char* name : {"concrete", "brick"}) {
    MaterialConfig material;
    material.name = name;
    material.scattering = 0.4;
    material.scattering_lobe = 4;
    material.scattering_cross_polar = 0.2;
    config.materials.push_back(material);
  }
  return config;
}

std::vector<Part> parts_of(const std::vector<Quad>& quads) {
  std::vector<Part> parts{{{quads[0]}, "concrete"}, {{}, "brick"}, {{quads.back()}, "glass"}};
  parts[1].quads.assign(quads.begin() + 1, quads.end() - 1);
  return parts;
}

}  // namespace

TEST_CASE("every kind of path is the same path the other way") {
  Kinds all;
  const SceneFile house(parts_of(l_shaped())), free_standing(parts_of(screens()));
  for (const auto& [file, from, to] : {std::tuple{&house, glm::dvec3{-10.7, -6.3, 1.9}, glm::dvec3{3.9, 6.1, 2.2}},
                                       {&house, {9.7, -7.1, 2.7}, {-9.7, 9.9, 6.1}},
                                       {&house, {9.7, -7.1, 2.7}, {11.3, 8.1, 2.2}},
                                       {&free_standing, {-9.3, 0.7, 1.9}, {9.1, -1.2, 2.3}},
                                       {&free_standing, {-9.3, 0.7, 1.9}, {1.3, 2.1, 3.7}}}) {
    for (const auto& [kind, count] : exchange(everything(*file, from, to))) all[kind] += count;
  }
  for (const char* kind :
       {"R", "RR", "T", "TT", "RT", "D", "DR", "DRR", "DT", "DTT", "DRT", "DD", "DDR", "DDT", "S", "ST"}) {
    CAPTURE(std::string(kind));
    CHECK(all[kind] > 0);
  }
}

TEST_CASE("paths that scatter between reflections are the same paths the other way") {
  const SceneFile house(parts_of(l_shaped()));
  Kinds all;
  for (const double lobe : {0.0, 4.0}) {
    Config config = everything(house, {9.7, -7.1, 2.7}, {-9.7, 9.9, 6.1});
    for (MaterialConfig& material : config.materials) material.scattering_lobe = lobe;
    config.trace.diffraction = false;
    config.trace.rays = 50000;
    config.trace.tile_m = 5;
    config.trace.scattering_reflections = 2;
    config.trace.max_depth = 4;
    for (const auto& [kind, count] : exchange(config, 1e-12)) all[kind] += count;
  }
  for (const char* kind : {"S", "RS", "RRS", "RST", "RSTT"}) {
    CAPTURE(std::string(kind));
    CHECK(all[kind] > 0);
  }
}

TEST_CASE("two edges of one sheet, between which the wave runs along either side of it") {
  const SceneFile panel(std::vector<Quad>{{{-1.7, -2.3, 6.3}, {3.6, 0.3, 0.5}, {-0.2, 1.3, 4.1}}});
  Kinds all;
  for (const glm::dvec3& to : {glm::dvec3{9.1, -1.2, 2.3}, {2.1, 7.7, 8.9}, {0.3, -6.1, 9.4}, {-4.4, 5.2, 3.1}}) {
    for (const auto& [kind, count] : exchange(everything(panel, {-9.3, 0.7, 1.9}, to))) all[kind] += count;
  }
  CHECK(all["DD"] >= 4);
}

TEST_CASE("an end on a wall, on the ground or on an edge: every path is the same path the other way") {
  const SceneFile house(parts_of(l_shaped()));
  Kinds all;
  for (const double gap_m : {-5e-5, 1e-7, 5e-5}) {
    CAPTURE(gap_m);
    const glm::dvec3 wall(-1.1, -4.2 - gap_m, 1.9), foot(3.9, -9.1, gap_m), edge(5.3 + gap_m, -4.2 - gap_m, 2.2);
    for (const auto& [from, to] : {std::pair{wall, glm::dvec3(9.7, -7.1, 2.7)},
                                   {foot, {11.3, 8.1, 2.2}},
                                   {edge, {9.7, -7.1, 2.7}},
                                   {wall, foot}}) {
      Config config = everything(house, from, to);
      config.trace.rays = 100000;
      config.trace.max_diffractions = 1;  // two edges of the sheet that an end stands on are beyond what is computed
      for (const auto& [kind, count] : exchange(config)) all[kind] += count;
    }
  }
  for (const char* kind : {"R", "D", "DR", "DRR", "DT", "S"}) {
    CAPTURE(std::string(kind));
    CHECK(all[kind] > 0);
  }
}
