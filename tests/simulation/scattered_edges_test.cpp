// SPDX-License-Identifier: Apache-2.0
// Paths over tiles with an edge beside the tile: each is the product of two ways that frames without the tile compute,
// between an antenna and one in the place of the tile, and of the tile's matrix; there is one for each pair of ways.
// The way back, rays, lists in parts, and the floor, which loses no stronger path.
#include <cstdlib>
#include <map>
#include <set>

#include "radio/field_tables.hpp"
#include "scene/load.hpp"
#include "scene/tiles.hpp"
#include "simulation/bends.hpp"
#include "simulation/run.hpp"
#include "wavetracer/device/path_field.h"
#include "wavetracer/interaction_kinds.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

using PortMatrix = std::array<std::complex<double>, 4>;  // receiver's port 2 r + transmitter's port t

// A way between an antenna and a tile, or a path: its steps, its field, and the direction of the wave at the tile's
// end.
struct Way {
  std::string kinds, steps;
  std::vector<uint32_t> mirrors;  // from the first on
  double delay_s;
  PortMatrix a;
  dvec3 departs, arrives;
  long edges() const { return std::ranges::count(kinds, 'D'); }
};

dvec3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// tile_at: names the tile at a place.
template <class TileAt>
std::vector<Way> ways_of(const Paths& paths, const TileAt& tile_at) {
  std::vector<Way> out;
  for (size_t i = 0; i < paths.size(); ++i) {
    Way way{{},
            {},
            {},
            paths.delay_s[i],
            paths.a[i],
            direction(paths.aod_theta_rad[i], paths.aod_phi_rad[i]),
            direction(paths.aoa_theta_rad[i], paths.aoa_phi_rad[i])};
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
      const uint8_t kind = paths.vertex_interaction[k];
      way.kinds += kind == scattering ? 'S' : kind == diffraction ? 'D' : 'R';
      if (kind == reflection) way.mirrors.push_back(paths.vertex_surface[k]);
      way.steps += fmt::format("{}{} ", way.kinds.back(),
                               kind == scattering ? tile_at(paths.vertex_position_m[k]) : paths.vertex_surface[k]);
    }
    out.push_back(way);
  }
  return out;
}

device::wt_double3 as_device(const dvec3& v) { return {v.x, v.y, v.z}; }
dvec3 as_host(const device::wt_double3& v) { return {v.x, v.y, v.z}; }

uint64_t hash_of(const std::vector<uint32_t>& from_tile) {
  uint64_t hash = 0;
  for (const uint32_t surface : from_tile) hash = device::wt_mixed(hash + 1 + surface);
  return hash;
}

double size_of(const PortMatrix& a) {
  double sum = 0;
  for (const auto& x : a) sum += std::norm(x);
  return std::sqrt(sum);
}

// Boxes or screens on a ground, and a rough plate among them.
struct RoughWorld {
  Config config;
  Scene scene;
  std::vector<Tile> tiles;
  FieldTables tables;

  RoughWorld(const SceneFile& file, const dvec3& from, const dvec3& to, uint32_t reflections)
      : config(config_of(file.path(), {from}, {to}, 2000, 4)) {
    MaterialConfig& rough = config.materials.emplace_back();
    rough.name = "concrete";
    rough.permittivity = 4;
    rough.conductivity_s_m = 0.02;
    rough.scattering = 0.6;
    rough.scattering_lobe = 3;
    rough.scattering_cross_polar = 0.2;
    config.trace.discovery = "beams";
    config.trace.diffraction = true;
    config.trace.scattering = true;
    config.trace.tile_m = 1.5;
    config.trace.scattering_reflections = reflections;
    config.trace.scattering_diffraction = true;
    scene = load_scene(config);
    tiles = make_tiles(scene, config.trace.tile_m);
    tables = make_field_tables(scene, config);
  }

  uint32_t tile_at(const dvec3& p) const {
    for (uint32_t i = 0; i < tiles.size(); ++i)
      if (glm::distance(tiles[i].centre_m + scene.origin_m, p) < 1e-9) return i;
    FAIL("no tile is here");
    return 0;
  }
  std::vector<Way> ways(const Config& of) const {
    return ways_of(run(of).paths, [&](const dvec3& p) { return tile_at(p); });
  }
  // Ways between antennas, one of them in the place of a tile.
  std::vector<Way> halves(const dvec3& from, const dvec3& to, uint32_t interactions) const {
    Config half = config;
    half.transmitters[0].position_m = {from.x, from.y, from.z};
    half.receivers[0].position_m = {to.x, to.y, to.z};
    half.trace.max_depth = interactions;
    half.trace.scattering_reflections = 0;
    half.trace.scattering_diffraction = false;
    std::vector<Way> out = ways(half);
    std::erase_if(out, [](const Way& way) { return way.kinds.find('S') != std::string::npos; });
    return out;
  }
  // The path of two ways over a tile.
  PortMatrix product(uint32_t tile, const Way& before, const Way& after) const {
    const Surface& surface = scene.surfaces[tiles[tile].surface];
    std::vector<uint32_t> back(before.mirrors.rbegin(), before.mirrors.rend());
    const dvec3 in = -before.arrives, out = after.departs;
    const device::wt_wave_map map =
        device::wt_scatter(&tables.materials[surface.material], device::wt_no_layers(), tables.wavelength_m,
                           as_device(in), as_device(out), as_device(surface.normal), tiles[tile].area_m2,
                           config.trace.seed, tile, hash_of(back) + hash_of(after.mirrors));
    const device::wt_basis heard = device::wt_spherical_basis(as_device(before.arrives)),
                           sent = device::wt_spherical_basis(as_device(out));
    const std::array<dvec3, 2> from{as_host(map.from.first), as_host(map.from.second)},
        to{as_host(map.to.first), as_host(map.to.second)}, come{as_host(heard.first), as_host(heard.second)},
        go{as_host(sent.first), as_host(sent.second)};
    PortMatrix turned{}, all{};
    for (size_t r = 0; r < 2; ++r)
      for (size_t t = 0; t < 2; ++t)
        for (size_t i = 0; i < 2; ++i)
          for (size_t j = 0; j < 2; ++j)
            turned[2 * r + t] += std::complex<double>(map.matrix.m[2 * i + j].x, map.matrix.m[2 * i + j].y) *
                                 (glm::dot(go[r], to[i]) * glm::dot(from[j], come[t]));
    const double scale = 4 * std::acos(-1.0) / tables.wavelength_m;
    for (size_t r = 0; r < 2; ++r)
      for (size_t t = 0; t < 2; ++t)
        for (size_t i = 0; i < 2; ++i)
          for (size_t j = 0; j < 2; ++j)
            all[2 * r + t] += scale * after.a[2 * r + i] * turned[2 * i + j] * before.a[2 * j + t];
    return all;
  }
};

const dvec3 from{-11.3, -5.7, 1.6}, to{11.9, 3.3, 1.9};
const std::vector<Quad> plate{{{-1.9, 5.2, 0.4}, {2.1, 0.7, 0}, {0.1, 0.2, 1.7}}};

std::vector<Part> among(const std::vector<Quad>& smooth) { return {{smooth, "metal"}, {plate, "concrete"}}; }

bool beside_edge(const Way& way) { return way.edges() > 0 && way.kinds.find('S') != std::string::npos; }

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Variable() { unsetenv(name_); }

 private:
  const char* name_;
};

}  // namespace

TEST_CASE("edges beside a tile: every pair of ways, and its field is the product of theirs and of the tile") {
  for (const std::vector<Quad>& quads : {two_boxes(), screens()}) {
    const SceneFile file(among(quads));
    const RoughWorld world(file, from, to, 2);
    REQUIRE(world.tiles.size() > 1);
    std::map<std::string, std::pair<double, PortMatrix>> expected;
    for (uint32_t tile = 0; tile < world.tiles.size(); ++tile) {
      const dvec3 centre = world.tiles[tile].centre_m + world.scene.origin_m;
      const dvec3 normal = world.scene.surfaces[world.tiles[tile].surface].normal;
      const std::vector<Way> first = world.halves(from, centre, 2), second = world.halves(centre, to, 2);
      for (const Way& a : first)
        for (const Way& b : second) {
          if (a.edges() + b.edges() != 1 || a.kinds.size() + b.kinds.size() > 3) continue;
          if ((a.edges() > 0 && a.kinds.back() != 'D') || (b.edges() > 0 && b.kinds.front() != 'D')) continue;
          const double in = glm::dot(a.arrives, normal), out = glm::dot(b.departs, normal);
          if (std::abs(in) < 1e-6 || std::abs(out) < 1e-6 || in * out < 0) continue;
          expected[a.steps + fmt::format("S{} ", tile) + b.steps] = {a.delay_s + b.delay_s, world.product(tile, a, b)};
        }
    }
    size_t found = 0, before = 0, mirrored = 0;
    for (const Way& way : world.ways(world.config)) {
      if (!beside_edge(way)) continue;
      CAPTURE(way.steps);
      ++found;
      const auto at = expected.find(way.steps);
      REQUIRE(at != expected.end());
      CHECK(std::abs(way.delay_s / at->second.first - 1) < 1e-12);
      PortMatrix apart = way.a;
      for (size_t i = 0; i < 4; ++i) apart[i] -= at->second.second[i];
      CHECK(size_of(apart) < 1e-9 * size_of(at->second.second));
      before += way.kinds.find('D') < way.kinds.find('S');
      mirrored += way.kinds.find('R') != std::string::npos;
    }
    CHECK(found == expected.size());
    CHECK(before > 3);
    CHECK(found > before + 3);
    CHECK(mirrored > 3);
  }
}

TEST_CASE(
    "edges beside a tile: other paths stay, the way back is the same, and rays and lists in parts find the same") {
  const SceneFile file(among(two_boxes()));
  const RoughWorld world(file, from, to, 1);
  const auto steps_of = [](const std::vector<Way>& ways, bool beside) {
    std::map<std::string, PortMatrix> out;
    for (const Way& way : ways)
      if (beside_edge(way) == beside) out[way.steps] = way.a;
    return out;
  };
  const std::vector<Way> all = world.ways(world.config);
  Config without = world.config;
  without.trace.scattering_diffraction = false;
  CHECK(steps_of(all, false) == steps_of(world.ways(without), false));
  CHECK(steps_of(world.ways(without), true).empty());
  const auto there = steps_of(all, true);
  REQUIRE(there.size() > 8);
  Config other = world.config;
  std::swap(other.transmitters, other.receivers);
  std::map<std::string, PortMatrix> back;
  for (const Way& way : world.ways(other)) {
    if (!beside_edge(way)) continue;
    std::string reversed;
    for (size_t end = way.steps.size(); end > 0;) {
      const size_t begin = end > 1 ? way.steps.rfind(' ', end - 2) : std::string::npos;
      const size_t first = begin == std::string::npos ? 0 : begin + 1;
      reversed += way.steps.substr(first, end - first);
      end = first;
    }
    back[reversed] = {way.a[0], way.a[2], way.a[1], way.a[3]};
  }
  REQUIRE(back.size() == there.size());
  for (const auto& [steps, a] : there) {
    CAPTURE(steps);
    REQUIRE(back.contains(steps));
    PortMatrix apart = a;
    for (size_t i = 0; i < 4; ++i) apart[i] -= back[steps][i];
    CHECK(size_of(apart) <= 1e-9 * size_of(a));
  }
  Config sampled = world.config;
  sampled.trace.discovery = "rays";
  sampled.trace.rays = 200000;
  CHECK(steps_of(world.ways(sampled), true) == there);
  const Variable points("WAVETRACER_MOST_POINTS", "40"), candidates("WAVETRACER_MOST_CANDIDATES", "30");
  CHECK(steps_of(world.ways(world.config), true) == there);
}

TEST_CASE("edges beside a tile: the floor leaves out weaker paths alone, and free ends of edges are no exception") {
  const SceneFile file(among(screens()));
  RoughWorld world(file, from, to, 2);
  for (const bool ends : {false, true}) {
    world.config.trace.edge_ends = ends;
    world.config.trace.scattering_floor_db = {};
    std::vector<Way> all = world.ways(world.config);
    std::erase_if(all, [](const Way& way) { return !beside_edge(way); });
    std::ranges::sort(all, std::greater(), [](const Way& way) { return size_of(way.a); });
    REQUIRE(all.size() > 20);
    for (const size_t place : {all.size() / 8, all.size() / 3, all.size() - 1}) {
      // The gain of a path between any antennas is at most the sum of the squares of its matrix, and it is half of it
      // for some.
      const double floor_db = 20 * std::log10(size_of(all[place].a)) - 3.02;
      world.config.trace.scattering_floor_db = floor_db;
      const FrameResult frame = run(world.config);
      std::set<std::string> left;
      for (const Way& way : ways_of(frame.paths, [&](const dvec3& p) { return world.tile_at(p); }))
        if (beside_edge(way)) left.insert(way.steps);
      for (size_t i = 0; i <= place; ++i) {
        CAPTURE(all[i].steps);
        CHECK(left.contains(all[i].steps));
      }
      if (!ends && place == all.size() / 8) CHECK(left.size() < all.size());
    }
    world.config.trace.scattering_floor_db = 20 * std::log10(size_of(all[0].a)) + 40;
    for (const Way& way : world.ways(world.config)) CHECK_FALSE(beside_edge(way));
  }
}
