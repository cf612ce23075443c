// SPDX-License-Identifier: Apache-2.0
// The generated city: the same bytes everywhere, closed buildings, free streets, files that give the mesh in memory.
// The expected hash was recorded once; it changes only when the generator does.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "base/file.hpp"
#include "scene/city.hpp"
#include "scene/mitsuba.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

namespace {

uint64_t fnv1a(uint64_t hash, std::string_view bytes) {
  for (unsigned char c : bytes) hash = (hash ^ c) * 0x100000001B3u;
  return hash;
}

// Returns a hash of all files, in the order of their names.
uint64_t hash_of(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.insert(entry.path());
  }
  uint64_t hash = 0xCBF29CE484222325u;
  for (const auto& file : files) hash = fnv1a(fnv1a(hash, file.filename().string()), read_file(file));
  return hash;
}

bool is_building(const RawMesh& mesh) { return mesh.name.starts_with("building"); }

}  // namespace

TEST_CASE("the city's bytes depend on its options only") {
  const test::TemporaryFolder folder;
  const CityOptions small = parse_city_options("--blocks 2 --seed 5");
  write_city(small, folder.path() / "a");
  write_city(small, folder.path() / "b");
  CHECK(hash_of(folder.path() / "a") == hash_of(folder.path() / "b"));
  CHECK(hash_of(folder.path() / "a") == 15863718136361883945u);
  write_city(parse_city_options("--blocks 2 --seed 6"), folder.path() / "c");
  CHECK(hash_of(folder.path() / "a") != hash_of(folder.path() / "c"));
}

TEST_CASE("files and memory give the same scene") {
  const test::TemporaryFolder folder;
  Config config;
  config.scene.generate = "--seed 3 --blocks=3x2";
  write_city(parse_city_options(config.scene.generate), folder.path());
  const Scene memory = load_scene(config), file = load_scene_file(folder.path() / "city.xml", {});
  CHECK(memory.vertices == file.vertices);
  CHECK(memory.triangles == file.triangles);
  CHECK(memory.objects == file.objects);
  CHECK(memory.materials == file.materials);
  CHECK(memory.triangle_surface == file.triangle_surface);
}

TEST_CASE("the default city") {
  const RawScene raw = generate_city({});
  const auto buildings = std::count_if(raw.meshes.begin(), raw.meshes.end(), is_building) / 2;
  CHECK(buildings >= 200);
  CHECK(buildings <= 400);
  CHECK(raw.materials.size() >= 5);
  Config config;
  config.scene.generate = "--seed 1";
  const Scene scene = load_scene(config);
  CHECK(scene.report.degenerate_triangles == 0);
  CHECK(scene.report.duplicate_triangles == 0);
  CHECK(scene.report.warnings.empty());
  CHECK(scene.report.free_edges == 4);  // those of the ground
  CHECK(scene.report.nonmanifold_edges == 0);
  CHECK(scene.upper.x - scene.lower.x == 660);
}

TEST_CASE("buildings are closed, wound outwards and clear of the streets, for any options") {
  for (const char* text :
       {"", "--seed 2", "--seed 99 --block-m 60 --street-m 9", "--block-m 200 --floors 1:2 --seed 4"}) {
    CAPTURE(text);
    const CityOptions options = parse_city_options(text);
    const RawScene raw = generate_city(options);
    const double pitch = options.block_m + options.street_m;
    std::map<std::string, double> volume;  // six times it, by building: positive for outward faces
    std::map<std::string, std::map<std::array<double, 6>, int>> sides;  // directed edges, each against its reverse
    for (const RawMesh& mesh : raw.meshes) {
      if (!is_building(mesh)) continue;
      const std::string name = mesh.name.substr(0, 13);
      for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        volume[name] += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
        for (size_t k = 0; k < 3; ++k) {
          const glm::dvec3 &p = mesh.vertices[t[k]], &q = mesh.vertices[t[(k + 1) % 3]];
          ++sides[name][{p.x, p.y, p.z, q.x, q.y, q.z}];
          --sides[name][{q.x, q.y, q.z, p.x, p.y, p.z}];
        }
      }
      for (const glm::dvec3& v : mesh.vertices) {
        for (int k = 0; k < 2; ++k) {  // distance to the nearest street centre line of this axis
          const double blocks = k == 0 ? options.blocks_x : options.blocks_y;
          const double along = v[k] / pitch + blocks / 2;
          CHECK(std::abs(along - std::round(along)) * pitch >= options.street_m / 2.0 - 1e-9);
        }
      }
    }
    CHECK(volume.size() >= 36);
    for (const auto& [name, six_volumes] : volume) CHECK(six_volumes > 0);
    for (const auto& [name, edges] : sides) {
      CHECK(std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; }));
    }
  }
}

TEST_CASE("example positions stand in the streets") {
  for (const char* text : {"", "--blocks 3x2", "--blocks 5 --street-m 12 --block-m 90"}) {
    const CityOptions options = parse_city_options(text);
    const double pitch = options.block_m + options.street_m;
    for (const CityPosition& p : example_positions(options)) {
      CAPTURE(p.name);
      const double x = p.position_m[0] / pitch + options.blocks_x / 2.0,
                   y = p.position_m[1] / pitch + options.blocks_y / 2.0;
      const double nearest = std::min(std::abs(x - std::round(x)), std::abs(y - std::round(y))) * pitch;
      CHECK(nearest < options.street_m / 2.0);
      CHECK(p.position_m[2] >= 1);
    }
  }
}

TEST_CASE("city options") {
  const CityOptions options =
      parse_city_options("  --seed 12 --blocks=4x8\t--block-m 100 --street-m=15 --floors 2:5 --ground wet_ground ");
  CHECK(options.seed == 12);
  CHECK(options.blocks_x == 4);
  CHECK(options.blocks_y == 8);
  CHECK(options.block_m == 100);
  CHECK(options.street_m == 15);
  CHECK(options.min_floors == 2);
  CHECK(options.max_floors == 5);
  CHECK(options.ground == "wet_ground");
  for (const char* bad : {"--seeds 1", "--seed", "--seed -1", "--blocks 0", "--blocks 4x", "--block-m 10",
                          "--floors 5:2", "--ground mud", "7"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(parse_city_options(bad), Contains("options: --seed N"), ConfigError);
  }
}

TEST_CASE("a folder that cannot be written is an error") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("file", "x");
  CHECK_THROWS_WITH_AS(write_city(parse_city_options("--blocks 1"), file / "city"), Contains("cannot be created"),
                       RuntimeError);
}
