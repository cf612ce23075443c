// SPDX-License-Identifier: Apache-2.0
// Worlds of boxes with paths of random sequences between random ends, which can be solved anew when an end has moved.
// Planes and edges are endless and nothing is hidden. Every path has a link of its own, so rows keep their order.
#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "gradient/path_gradient.hpp"
#include "radio/antenna.hpp"
#include "radio/cells.hpp"
#include "radio/world.hpp"
#include "scene/tiles.hpp"
#include "scene/wedge_check.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer::test {

// The kinds of interactions of a sequence, in letters.
inline constexpr uint8_t R = reflection, T = transmission, D = diffraction, S = scattering;

struct GradientStep {
  uint8_t kind;
  uint32_t number;
};
using GradientSequence = std::vector<GradientStep>;

// A material whose law does not depend on the frequency.
inline Material plain_material(double permittivity, double conductivity_s_m, double thickness_m, double scattering) {
  Material out{"plain", permittivity, 0, conductivity_s_m, 0, 0, infinity, thickness_m};
  out.scattering = scattering;
  out.scattering_lobe = 3;
  out.scattering_cross_polar = 0.2;
  return out;
}

struct GradientWorld {
  Scene scene;
  Config config;
  std::vector<Tile> tiles;
  std::vector<Cell> cells;                  // numbered after the tiles
  std::vector<GradientSequence> sequences;  // one for each path; path i goes from transmitter i to receiver i
  WorldState state;
  std::vector<std::string> antennas{"isotropic", "dipole", "tr38901", "short-dipole"};
  bool one_link = false;  // all paths are of link 0

  static Scene boxes(std::mt19937_64& random) {
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    RawScene raw;
    raw.file = "test";
    ResolvedMaterials resolved;
    resolved.materials = {plain_material(5.24, 0.12, 0.21, 0.3), plain_material(6.3, 0.02, 0.011, 0.2),
                          plain_material(2.7, 0.004, 0.05, 0.4), plain_material(14, 0.6, infinity, 0.5)};
    const auto add = [&](RawMesh mesh, uint32_t material) {
      raw.meshes.push_back(std::move(mesh));
      resolved.mesh_material.push_back(material);
    };
    add(quad({-60, -60, 0}, {120, 0, 0}, {0, 120, 0}), 3);
    for (int i = 0; i < 3; ++i) {
      const dvec3 low{-30.0 + 22 * i + between(0, 4), between(-15, 5), 0};
      add(box(low, low + dvec3{between(6, 12), between(6, 12), between(5, 15)}, false), static_cast<uint32_t>(i));
    }
    // A corner of less than a half space, a slight bend between two screens, and their free edges.
    RawMesh building = l_building();
    for (dvec3& p : building.vertices) p += dvec3{0.4 * p.y - 10, 25, 0};  // a right angle would not diffract
    add(std::move(building), 0);
    const double rise = between(0.2, 1);
    add(mesh({{15, 20, 4}, {15, 32, 4}, {20, 20, 4 + rise}, {20, 32, 4 + rise}, {25, 20, 4}, {25, 32, 4}},
             {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}),
        1);
    return build_scene(raw, std::move(resolved), EdgeSearch::of_model, 0);
  }

  explicit GradientWorld(uint64_t seed) {
    std::mt19937_64 random(seed);
    scene = boxes(random);
    config.trace.scattering = true;
    config.trace.tile_m = 6;
    config.trace.max_depth = 6;
    config.trace.transmission = true;
    config.trace.max_transmissions = 3;
    tiles = make_tiles(scene, config.trace.tile_m);
  }

  void add(const GradientSequence& sequence, const dvec3& tx, const dvec3& rx, std::mt19937_64& random) {
    const auto turn = [&] { return std::uniform_real_distribution(-60.0, 60.0)(random); };
    const auto end = [&](const dvec3& place, SharedList<EndState>& states) {
      const std::string antenna = antennas[random() % antennas.size()];
      const std::array<double, 3> turns{turn(), turn(), turn()};
      const RadioEnd out = World::end(place, antenna, "VH", turns);
      states.push_back({.position_m = place, .rotation = rotation_of(out.orientation_deg)});
      return out;
    };
    config.transmitters.push_back(end(tx, state.transmitters));
    config.receivers.push_back(end(rx, state.receivers));
    sequences.push_back(sequence);
  }

  // The vertices of a sequence. with_room: nothing where a plane or an edge is not met as it should be, or hardly so.
  std::optional<std::vector<dvec3>> solve(const GradientSequence& sequence, const dvec3& tx, const dvec3& rx,
                                          bool with_room = true) const {
    const size_t depth = sequence.size();
    std::vector<dvec3> points(depth + 2, tx);
    points.back() = rx;
    std::vector<size_t> fixed{0};
    for (size_t k = 0; k < depth; ++k) {
      const auto [kind, number] = sequence[k];
      if (kind == scattering)
        points[k + 1] = number < tiles.size() ? tiles[number].centre_m : cells[number - tiles.size()].centre_m;
      if (kind == diffraction) points[k + 1] = scene.wedges[number].start;
      if (kind == scattering || kind == diffraction) fixed.push_back(k + 1);
    }
    fixed.push_back(depth + 1);
    for (int round = 0; round < 4000; ++round) {
      double moved = 0;
      for (size_t i = 1; i + 1 < fixed.size(); ++i) {
        if (sequence[fixed[i] - 1].kind != diffraction) continue;
        const Wedge& wedge = scene.wedges[sequence[fixed[i] - 1].number];
        const dvec3 a = image(sequence, points[fixed[i - 1]], fixed[i - 1], fixed[i], false) - wedge.start;
        const dvec3 b = image(sequence, points[fixed[i + 1]], fixed[i], fixed[i + 1], true) - wedge.start;
        const double p = glm::dot(a, wedge.along), q = glm::dot(b, wedge.along);
        const double from = glm::length(a - p * wedge.along), to = glm::length(b - q * wedge.along);
        const double place = on_edge(wedge, fixed.size() == 3, (p * to + q * from) / (from + to));
        const dvec3 next = wedge.start + wedge.along * place;
        moved = std::max(moved, glm::length(next - points[fixed[i]]));
        points[fixed[i]] = next;
      }
      if (moved < 1e-14) break;
    }
    for (size_t i = 0; i + 1 < fixed.size(); ++i)
      if (!place_between(sequence, points, fixed[i], fixed[i + 1]) && with_room) return {};
    if (with_room && !turns_well(sequence, points)) return {};
    return std::vector<dvec3>(points.begin() + 1, points.end() - 1);
  }

  PathGeometry geometry(const WorldState& at) const {
    PathGeometry out;
    for (uint32_t i = 0; i < sequences.size(); ++i) {
      const uint32_t link = one_link ? 0 : i;
      const auto vertices = solve(sequences[i], at.transmitters[link].position_m, at.receivers[link].position_m, false);
      out.tx.push_back(link);
      out.rx.push_back(link);
      for (size_t k = 0; k < vertices->size(); ++k) {
        out.surface.push_back(sequences[i][k].number);
        out.interaction.push_back(sequences[i][k].kind);
        out.vertex.push_back((*vertices)[k]);
      }
      out.first.push_back(out.surface.size());
    }
    return out;
  }

 private:
  // The place on an edge next to the shortest way: on its line, but for free ends of a path's only edge.
  static double on_edge(const Wedge& wedge, bool only, double place) {
    if (only && (wedge.free_ends & WT_FREE_START)) place = std::max(place, WT_END_INSET_M);
    if (only && (wedge.free_ends & WT_FREE_END)) place = std::min(place, wedge.length_m - WT_END_INSET_M);
    return place;
  }

  double height(const GradientStep& step, const dvec3& p) const {
    const Surface& s = scene.surfaces[step.number];
    return glm::dot(s.normal, p) - s.offset_m;
  }

  // The image of a point at the mirrors between places `begin` and `end` of the path.
  dvec3 image(const GradientSequence& sequence, dvec3 p, size_t begin, size_t end, bool backward) const {
    for (size_t i = 1; begin + i < end; ++i) {
      const GradientStep& step = sequence[(backward ? end - i : begin + i) - 1];
      if (step.kind == reflection) p -= 2 * height(step, p) * scene.surfaces[step.number].normal;
    }
    return p;
  }

  bool place_between(const GradientSequence& sequence, std::vector<dvec3>& points, size_t begin, size_t end) const {
    bool has_room = true;
    for (size_t at = end - 1; at > begin; --at) {
      const GradientStep& step = sequence[at - 1];
      const dvec3 from = image(sequence, points[begin], begin, at + 1, false), to = points[at + 1];
      const double a = height(step, from), b = height(step, to);
      has_room = has_room && a * b < -0.01;
      points[at] = from + (to - from) * (a / (a - b));
    }
    return has_room;
  }

  // Do legs have a length, and are both ends of an edge's legs in free space and off its boundaries?
  bool turns_well(const GradientSequence& sequence, const std::vector<dvec3>& points) const {
    for (size_t k = 0; k + 1 < points.size(); ++k)
      if (!(glm::length(points[k + 1] - points[k]) > 0.3)) return false;  // the shortest way may go over a corner
    for (size_t k = 0; k < sequence.size(); ++k) {
      const dvec3 in = points[k] - points[k + 1], out = points[k + 2] - points[k + 1];
      if (sequence[k].kind == scattering && sequence[k].number < tiles.size()) {
        const dvec3 n = scene.surfaces[tiles[sequence[k].number].surface].normal;
        if (glm::dot(in, n) * glm::dot(out, n) < 0.1) return false;
      }
      if (sequence[k].kind == reflection && height(sequence[k], points[k]) * height(sequence[k], points[k + 2]) < 0.01)
        return false;
      if (sequence[k].kind == diffraction && !bends_well(sequence, k, in, out)) return false;
    }
    return true;
  }

  // Does the leg between edges k and k + 1 run along a plane that both bound?
  bool runs_along(const GradientSequence& sequence, size_t k) const {
    if (k + 1 >= sequence.size() || sequence[k].kind != diffraction || sequence[k + 1].kind != diffraction)
      return false;
    for (const uint32_t v : scene.wedges[sequence[k].number].plane)
      for (const uint32_t w : scene.wedges[sequence[k + 1].number].plane)
        if (v == w) return true;
    return false;
  }

  bool bends_well(const GradientSequence& sequence, size_t k, const dvec3& in, const dvec3& out) const {
    const Wedge& wedge = scene.wedges[sequence[k].number];
    double azimuth[2];
    for (int side = 0; side < 2; ++side) {
      const dvec3 away = side == 0 ? in : out;
      azimuth[side] = std::atan2(glm::dot(away, wedge.normal), glm::dot(away, wedge.face));
      if (azimuth[side] < 0) azimuth[side] += 2 * pi;
      const double inside = std::min(azimuth[side], wedge.exterior_rad - azimuth[side]);
      const bool along = side == 0 ? k > 0 && runs_along(sequence, k - 1) : runs_along(sequence, k);
      if (inside < 0.05 && !(along && (std::abs(inside) < 1e-9 || std::abs(azimuth[side] - 2 * pi) < 1e-9)))
        return false;
      if (glm::length(glm::cross(away, wedge.along)) < 0.1 * glm::length(away)) return false;
    }
    for (const double turn : {std::abs(azimuth[1] - azimuth[0]), azimuth[1] + azimuth[0]})
      for (const double boundary : {pi, 2 * wedge.exterior_rad - pi})
        if (std::abs(turn - boundary) < 0.02) return false;
    return true;
  }
};

// Adds `count` paths with these kinds of interactions, at random surfaces, edges or tiles (or those of a list, if it is
// not empty) and between random ends.
inline void add_random(GradientWorld& world, const std::vector<uint8_t>& kinds, int count, std::mt19937_64& random,
                       const std::vector<uint32_t>& wedges = {}, const std::vector<uint32_t>& tiles = {}) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto any = [&](size_t all, const std::vector<uint32_t>& list) {
    return list.empty() ? static_cast<uint32_t>(random() % all) : list[random() % list.size()];
  };
  for (int tries = 0; count > 0 && tries < 400000; ++tries) {
    const dvec3 tx{between(-40, 40), between(-25, 25), between(1, 25)};
    const dvec3 rx{between(-40, 40), between(-25, 25), between(1, 25)};
    GradientSequence sequence;
    for (const uint8_t kind : kinds)
      sequence.push_back({kind, kind == diffraction  ? any(world.scene.wedges.size(), wedges)
                                : kind == scattering ? any(world.tiles.size(), tiles)
                                                     : any(world.scene.surfaces.size(), {})});
    bool repeats = false;
    for (size_t k = 1; k < sequence.size(); ++k)
      repeats = repeats || (sequence[k].kind == sequence[k - 1].kind && sequence[k].number == sequence[k - 1].number);
    if (repeats || !world.solve(sequence, tx, rx)) continue;
    world.add(sequence, tx, rx, random);
    --count;
  }
  REQUIRE(count == 0);
}

// The edges for which a test of the wedge is true.
template <class Test>
std::vector<uint32_t> edges_where(const GradientWorld& world, Test test) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < world.scene.wedges.size(); ++i)
    if (test(world.scene.wedges[i])) out.push_back(i);
  REQUIRE(!out.empty());
  return out;
}

}  // namespace wavetracer::test
