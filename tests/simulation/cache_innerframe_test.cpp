// SPDX-License-Identifier: Apache-2.0
// Tests coherence inside a frame: with exact keys paths are byte for byte those without a cache, also where every ray
// is launched twice; with quantised keys exactly as many segments are traced as there are keys. The scene is a street
// with cars.
#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config street_with_cars(const SceneFile& file, uint64_t rays) {
  Config config = config_of(file.path(), {{-40, 2, 6}}, {{40, 3, 1.5}, {-20, -6, 1.5}}, rays, 3);
  add_vehicles(config,
               {{"a", "passenger", {-30, 4, 0}, {12, 0, 0}, 0, 4}, {"c", "truck", {-5, -4, 0}, {7, 0, 0}, 0, 4}}, 0.5);
  config.trace.reuse = false;
  config.trace.directions = "random";
  return config;
}

FrameResult first_frame(const Config& config) { return Simulation(config).run_frame(0); }

// Counts the cells of directions that the unit sphere passes through.
uint64_t cells_of_sphere(uint32_t division) {
  uint64_t count = 0;
  const auto edge = [&](uint32_t cell) { return 2.0 * cell / division - 1; };
  for (uint32_t cell = 0; cell < division * division * division; ++cell) {
    double nearest = 0, farthest = 0;  // squared distances from the centre
    for (const uint32_t k : {cell % division, cell / division % division, cell / division / division}) {
      const double a = std::abs(edge(k)), b = std::abs(edge(k + 1));
      nearest += edge(k) <= 0 && edge(k + 1) >= 0 ? 0 : std::min(a, b) * std::min(a, b);
      farthest += std::max(a, b) * std::max(a, b);
    }
    count += nearest < 1 && farthest > 1;
  }
  return count;
}

void check_counts(const CacheSummary& cache) {
  CHECK(cache.hits + cache.shared + cache.traced == cache.lookups);
  CHECK(cache.groups <= cache.traced);
  uint64_t shared = 0;
  for (const uint64_t of_depth : cache.shared_per_depth) shared += of_depth;
  CHECK(shared == cache.shared);
}

}  // namespace

TEST_CASE("innerframe, exact keys: the paths of no cache, for every table, while vehicles move") {
  const SceneFile file(street());
  Config config = street_with_cars(file, 12000);
  // Two transmitters at one place send the same rays, which nevertheless form two groups.
  config.transmitters.push_back(config.transmitters.front());
  config.transmitters.back().name = "twin";
  Simulation plain(config);
  const std::vector<FrameResult> expected = {plain.run_frame(0), plain.run_frame(1)};
  REQUIRE(expected[0].counts.paths > 20);
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    config.cache.kind = kind;
    config.cache.key = "exact";
    config.cache.innerframe = true;
    Simulation simulation(config);
    for (uint32_t frame = 0; frame < 2; ++frame) {
      const FrameResult found = simulation.run_frame(frame);
      CHECK(identical(found.paths, expected[frame].paths));
      CHECK(found.counts.segments == expected[frame].counts.segments);
      CHECK(found.counts.hits == expected[frame].counts.hits);
      CHECK(found.counts.sequences == expected[frame].counts.sequences);
      check_counts(found.cache);
    }
  }
}

TEST_CASE("innerframe: one ray of a cell is traced, and cells are as many as the sphere of directions meets") {
  const SceneFile file(street());
  Config config = street_with_cars(file, 50000);
  config.tracks.clear();  // rays that leave a car are traced alone
  config.cache.kind = "concurrent";
  config.cache.hit_point = "cached";
  for (const uint32_t division : {10u, 40u}) {
    CAPTURE(division);
    config.cache.division = division;
    config.cache.innerframe = false;
    const FrameResult each = first_frame(config);
    config.cache.innerframe = true;
    const FrameResult grouped = first_frame(config);
    check_counts(each.cache);
    check_counts(grouped.cache);
    CHECK(each.cache.hits_per_depth[0] == 0);
    CHECK(each.cache.groups == 0);
    CHECK(each.cache.shared == 0);
    // Slivers of the sphere in a cell may be met by no ray.
    const uint64_t first_groups = 50000 - grouped.cache.shared_per_depth[0], cells = cells_of_sphere(division);
    CHECK(first_groups <= cells);
    CHECK(first_groups > cells * (division == 10 ? 85 : 80) / 100);
    CHECK(grouped.cache.traced == grouped.cache.groups);  // no thread refuses an entry
    CHECK(grouped.cache.stored == grouped.cache.traced);  // no key is written twice
    CHECK(grouped.cache.traced < each.cache.traced / 3);
  }
}

TEST_CASE("innerframe, quantised keys: the same in every run and with every batch of the device") {
  const SceneFile file(street());
  Config config = street_with_cars(file, 20000);
  config.cache.kind = "concurrent";
  config.cache.division = 30;
  config.cache.innerframe = true;
  for (const CacheHitPoint hit_point : std::to_array<CacheHitPoint>({"own", "cached"})) {
    CAPTURE(hit_point);
    config.cache.hit_point = hit_point;
    const FrameResult once = first_frame(config), again = first_frame(config);
    CHECK(identical(once.paths, again.paths));
    CHECK(once.cache.traced == again.cache.traced);
    CHECK(once.counts.hits == again.counts.hits);
    check_counts(once.cache);
    CHECK((once.cache.traced > once.cache.groups) ==
          (hit_point == "own"));  // some rays meet the plane outside of its surface
  }
}

TEST_CASE("innerframe: a table that is warm leaves nothing to group") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-40, 2, 6}}, {{40, 3, 1.5}}, 20000, 3);
  config.cache.kind = "concurrent";
  config.cache.division = 30;
  config.cache.hit_point = "cached";
  config.cache.innerframe = true;
  Simulation simulation(config);
  simulation.run_frame(0);
  const CacheSummary warm = simulation.run_frame(0).cache;
  CHECK(warm.hits == warm.lookups);
  CHECK(warm.groups == 0);
  CHECK(warm.traced == 0);
}

TEST_CASE("innerframe, reception by spheres: followers are received where the ray is that was traced") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-40, 2, 6}}, {{40, 3, 1.5}, {-20, -6, 1.5}}, 20000, 3);
  config.trace.reception = "sphere";
  config.trace.directions = "random";
  config.trace.reuse = false;
  const FrameResult plain = first_frame(config);
  config.cache.kind = "concurrent";
  config.cache.scope = "all";
  config.cache.hit_point = "cached";
  config.cache.innerframe = true;
  config.cache.division = 1000000;
  const FrameResult fine = first_frame(config);
  check_counts(fine.cache);
  CHECK(fine.counts.receptions >= plain.counts.receptions * 98 / 100);
  config.cache.division = 20;
  const FrameResult coarse = first_frame(config);
  check_counts(coarse.cache);
  CHECK(coarse.cache.shared > coarse.cache.lookups / 2);
  CHECK(coarse.counts.receptions > 0);
}
