// SPDX-License-Identifier: Apache-2.0
// Groups of rays of one key, compared with groups that the host finds by comparing every two rays.
// The division must be small, so that random rays share keys.
#include <doctest/doctest.h>

#include <map>

#include "passes/cache_groups.hpp"
#include "passes/cached_rays.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t static_surfaces = 400;  // random rays leave up to 449

// Random rays, some of them twice to the bit, of several transmitters.
std::vector<CachedRay> rays_with_twins(uint32_t seed, size_t count) {
  std::vector<CachedRay> rays = random_rays(seed, count, 3);
  Random random(seed + 1);
  for (size_t i = 0; i < count / 3; ++i) rays.push_back(rays[random.below(static_cast<uint32_t>(count))]);
  return rays;
}

// This follows the definition of the key (docs/architecture.md), without the hashes and cells of the cache.
bool same_key(const CacheConfig& config, const CachedRay& a, const CachedRay& b) {
  if (a.region != b.region || a.left != b.left) return false;
  if (config.exact()) return a.origin == b.origin && a.direction == b.direction;
  const auto cell = [&](float x) {
    const auto last = static_cast<int64_t>(config.division) - 1;
    return std::min(static_cast<int64_t>(std::floor((x + 1.0f) * (0.5f * static_cast<float>(config.division)))), last);
  };
  for (size_t axis = 0; axis < 3; ++axis)
    if (cell(a.direction[axis]) != cell(b.direction[axis])) return false;
  return true;
}

bool may_share(const CacheConfig& config, const CachedRay& ray) {
  return config.exact() || config.holds_all() || ray.left == WT_NONE || ray.surface < static_surfaces;
}

// Returns the first ray of the group that each ray follows, WT_NONE if it is the first, alone or not missed.
std::vector<uint32_t> brute_force(const CacheConfig& config, std::span<const CachedRay> rays,
                                  const std::vector<bool>& missed) {
  std::vector<uint32_t> follows(rays.size(), WT_NONE);
  for (uint32_t i = 0; i < rays.size(); ++i)
    for (uint32_t j = 0; missed[i] && may_share(config, rays[i]) && j < i && follows[i] == WT_NONE; ++j)
      if (missed[j] && follows[j] == WT_NONE && may_share(config, rays[j]) && same_key(config, rays[i], rays[j]))
        follows[i] = j;
  return follows;
}

gpu::Buffer<float> marks_of(const std::vector<bool>& missed, uint32_t capacity) {
  std::vector<float> marks(capacity, std::bit_cast<float>(WT_NONE));
  for (uint32_t i = 0; i < missed.size(); ++i)
    if (missed[i]) marks[i] = std::bit_cast<float>(i);
  return context().buffer(marks, "missed");
}

std::vector<bool> marked(const gpu::Buffer<float>& marks, size_t count) {
  std::vector<bool> out;
  const std::vector<float> words = marks.read(0, count);
  for (uint32_t i = 0; i < count; ++i) {
    const auto word = std::bit_cast<uint32_t>(words[i]);
    if (word != WT_NONE && word != i) throw std::logic_error("a mark is neither i nor WT_NONE");
    out.push_back(word == i);
  }
  return out;
}

// Runs one queue through elect() and share().
struct Grouped {
  std::vector<uint32_t> follows;
  std::vector<bool> traced, missed, refused;  // after elect(); after share()
  std::vector<Hit> hits;
  std::vector<Ray> rays;
  std::vector<uint32_t> receivers, entries;
};

// hits[i]: the result of tracing ray i. surfaces: of the scene.
Grouped run_groups(const CacheConfig& config, std::span<const CachedRay> rays, const std::vector<bool>& missed,
                   std::span<const Hit> hits, std::vector<wt_surface> surfaces = {}) {
  CacheTable table = make_cache_table(context(), config, 3, 1000, 1000);
  CacheGroups groups(context(), table);
  DeviceScene scene;
  surfaces.resize(1000);
  scene.surfaces = context().buffer(surfaces, "surfaces");
  RayQueue queue = upload(rays);
  HitList list = upload_hits(hits);
  auto marks = marks_of(missed, queue.capacity), refused = context().buffer<float>(queue.capacity, "refused");
  std::vector<uint32_t> every(rays.size());
  std::iota(every.begin(), every.end(), 100u);
  auto receivers = context().buffer(every, "receivers");
  groups.reserve(queue.capacity);
  groups.elect(queue, marks, static_cast<uint32_t>(std::count(missed.begin(), missed.end(), true)), table,
               static_surfaces);
  Grouped out;
  out.follows = groups.representatives().read(0, rays.size());
  out.traced = marked(marks, rays.size());
  groups.share(scene, queue, list, marks, refused, table, 1, &receivers);
  out.missed = marked(marks, rays.size());
  out.refused = marked(refused, rays.size());
  out.hits = download(list, rays.size());
  out.rays = download(queue);
  out.receivers = receivers.read();
  out.entries = entries_of(queue);
  return out;
}

CacheConfig innerframe(CacheKey key, CacheHitPoint hit_point = "cached") {
  CacheConfig config = small_cache("concurrent", key);
  config.hit_point = hit_point;
  config.innerframe = true;
  return config;
}

}  // namespace

TEST_CASE("cache_groups: groups are those of brute force, and the first ray of the queue stands for each") {
  const std::vector<CachedRay> rays = rays_with_twins(5, 3000);
  const std::vector<Hit> hits = hits_of(rays.size());
  Random random(6);
  for (const CacheKey key : std::to_array<CacheKey>({"exact", "quantised"}))
    for (const CacheScope scope : std::to_array<CacheScope>({"static", "all"})) {
      if (key == "exact" && scope == "all") continue;
      CAPTURE(key);
      CAPTURE(scope);
      CacheConfig config = innerframe(key);
      config.scope = scope;
      config.division = 4;
      for (const uint32_t answered_of_8 : {0u, 3u}) {
        std::vector<bool> missed;
        for (size_t i = 0; i < rays.size(); ++i) missed.push_back(random.below(8) >= answered_of_8);
        const std::vector<uint32_t> expected = brute_force(config, rays, missed);
        const Grouped found = run_groups(config, rays, missed, hits);
        CHECK(found.follows == expected);
        size_t followers = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
          CHECK(found.traced[i] == (missed[i] && expected[i] == WT_NONE));
          followers += expected[i] != WT_NONE;
        }
        CHECK(followers > rays.size() / (key == "exact" ? 20 : 8));
        CHECK(found.missed == found.traced);
      }
    }
}

TEST_CASE("cache_groups: every ray of a group takes the hit of the one that was traced, and its way") {
  const std::vector<CachedRay> rays = rays_with_twins(7, 2000);
  const std::vector<Hit> hits = hits_of(rays.size());
  const std::vector<bool> missed(rays.size(), true);
  for (const CacheKey key : std::to_array<CacheKey>({"exact", "quantised"})) {
    CAPTURE(key);
    CacheConfig config = innerframe(key);
    if (key == "quantised") config.scope = "all";
    config.division = 4;
    const Grouped found = run_groups(config, rays, missed, hits);
    size_t moved = 0;
    for (uint32_t i = 0; i < rays.size(); ++i) {
      const uint32_t from = found.follows[i] == WT_NONE ? i : found.follows[i];
      CHECK(found.hits[i].t == hits[from].t);
      CHECK(found.hits[i].primitive == hits[from].primitive);
      CHECK(found.hits[i].surface == hits[from].surface);
      CHECK(found.rays[i].origin == rays[from].origin);
      CHECK(found.rays[i].direction == rays[from].direction);
      if (config.holds_all()) CHECK(found.receivers[i] == 100 + from);
      CHECK_FALSE(found.refused[i]);
      moved += rays[i].origin != rays[from].origin;
    }
    CHECK((moved > 0) == (key == "quantised"));
  }
}

TEST_CASE("cache_groups: with hit_point own a ray meets the plane itself, and is traced where it misses the surface") {
  // All rays of one cell go down; the first meets surface 0 at (0, 0, 0), which reaches 1 m from there.
  std::vector<CachedRay> rays;
  std::vector<Hit> hits;
  for (const float x : {0.0f, 0.5f, 3.0f, -0.75f}) {
    rays.push_back({.origin = {x, 0, 2}, .direction = {0, 0, -1}});
    hits.push_back({2, 0, 0});
  }
  rays.push_back({.origin = {0, 0, 2}, .direction = {0, 0, 1}});  // meets nothing, and so does the next
  rays.push_back({.origin = {9, 0, 2}, .direction = {0, 0, 1}});
  hits.resize(6, {0, WT_NONE, WT_NONE});
  rays[3].origin[2] = 4;
  const std::vector<wt_surface> floor = {{.normal = {0, 0, 1}, .offset = 0, .lower = {-1, -1, 0}, .upper = {1, 1, 0}}};
  const Grouped found = run_groups(innerframe("quantised", "own"), rays, std::vector<bool>(6, true), hits, floor);
  CHECK(found.follows == std::vector<uint32_t>{WT_NONE, 0, 0, 0, WT_NONE, 4});
  CHECK(found.refused == std::vector<bool>{false, false, true, false, false, false});
  CHECK(found.missed == std::vector<bool>{true, false, true, false, true, false});
  CHECK(found.hits[1].t == 2);
  CHECK(found.hits[3].t == 4);
  CHECK(found.hits[5].surface == WT_NONE);
  CHECK(found.rays[1].origin == rays[1].origin);
}

TEST_CASE("cache_groups: with purge precision a ray farther away than the residual is traced") {
  std::vector<CachedRay> rays;
  for (const float x : {0.0f, 0.4f, 0.6f}) rays.push_back({.origin = {x, 0, 2}, .direction = {0, 0, -1}});
  CacheConfig config = innerframe("quantised");
  config.purge = "precision";
  config.residual_value = 0.5;
  const Grouped found = run_groups(config, rays, std::vector<bool>(3, true), hits_of(3));
  CHECK(found.follows == std::vector<uint32_t>{WT_NONE, 0, 0});
  CHECK(found.refused == std::vector<bool>{false, false, true});
  CHECK(found.hits[1].t == found.hits[0].t);
  CHECK(found.hits[2].t == hits_of(3)[2].t);
}

TEST_CASE("cache_groups: a queue that it has no room for is refused") {
  const std::vector<CachedRay> rays = random_rays(9, 2000);
  const CacheConfig config = innerframe("exact");
  const CacheTable table = make_cache_table(context(), config, 1, 1000, 1000);
  CacheGroups groups(context(), table);
  groups.reserve(256);
  const RayQueue queue = upload(rays);
  auto marks = marks_of(std::vector<bool>(rays.size(), true), queue.capacity);
  CHECK_THROWS_AS(groups.elect(queue, marks, queue.count, table, WT_NONE), std::invalid_argument);
}
