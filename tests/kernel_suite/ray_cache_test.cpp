// SPDX-License-Identifier: Apache-2.0
// The public RayCache against maps of the host: an exact table answers the rays that were stored and no others; a
// quantised one answers by cells of directions, and with the points of the rays' own lines.
#include "wavetracer/kernels/ray_cache.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <unordered_map>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/soup.hpp"
#include "kernel_suite/user.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;
using wavetracer::CacheConfig;
using wavetracer::CacheKind;

namespace {

constexpr size_t batch = 400;

CacheConfig table_of(CacheKind kind, wavetracer::CacheKey key) {
  CacheConfig config;
  config.kind = kind;
  config.key = key;
  config.buffer_size = 1 << 15;
  config.hit_point = "cached";
  config.readers_number = 1000;  // no entry wears out
  return config;
}

// The key of an exact table: the ray, to the last bit, its triangle and its region.
std::string exact_key(const kernels::Ray& ray, uint32_t left, uint32_t region) {
  std::string key(32, '\0');
  std::memcpy(key.data(), ray.origin, 12);
  std::memcpy(key.data() + 12, ray.direction, 12);
  std::memcpy(key.data() + 24, &left, 4);
  std::memcpy(key.data() + 28, &region, 4);
  return key;
}

// A tracer of the user's own, which knows nothing of triangles: any hit that names the ray.
kernels::Hit made_hit(uint32_t number) { return {1.0f + static_cast<float>(number), number, 0.5f, 0.25f}; }

struct Batch {
  std::vector<kernels::Ray> rays;
  std::vector<uint32_t> left, regions;
};

// Rays of which many come again in later batches.
Batch batch_of(uint32_t seed, uint32_t regions) {
  const std::vector<kernels::Ray> pool = rays_in_cube(600, 10, 1);
  Numbers numbers(seed);
  Batch out;
  for (size_t i = 0; i < batch; ++i) {
    const uint32_t k = numbers.below(600);
    out.rays.push_back(pool[k]);
    out.left.push_back(k % 4 ? k : kernels::no_triangle);
    out.regions.push_back(k % 7 % regions);
  }
  return out;
}

struct Buffers {
  explicit Buffers(const kernels::Context& context)
      : rays(context.buffer<kernels::Ray>(batch)),
        hits(context.buffer<kernels::Hit>(batch)),
        traced(context.buffer<kernels::Hit>(batch)),
        left(context.buffer<uint32_t>(batch)),
        regions(context.buffer<uint32_t>(batch)) {}
  kernels::Buffer<kernels::Ray> rays;
  kernels::Buffer<kernels::Hit> hits, traced;
  kernels::Buffer<uint32_t> left, regions;
};

// Looks a batch up, and stores made hits for the rays that are missed.
struct Round {
  std::vector<uint32_t> missed;
  std::vector<kernels::Hit> answers, finals;
};
Round run(kernels::RayCache& cache, const Buffers& b, const Batch& asked, uint32_t first_number) {
  b.rays.write(asked.rays);
  b.left.write(asked.left);
  b.regions.write(asked.regions);
  const kernels::RayCache::Misses& misses = cache.look_up(b.rays, batch, b.hits, &b.left, &b.regions);
  Round out{misses.indices.read(0, misses.count), b.hits.read(), {}};
  const std::vector<kernels::Ray> given = misses.rays.read(0, misses.count);
  for (size_t k = 0; k < misses.count; ++k)
    REQUIRE(std::memcmp(given[k].origin, asked.rays[out.missed[k]].origin, 12) == 0);
  std::vector<kernels::Hit> traced;
  for (size_t k = 0; k < misses.count; ++k) traced.push_back(made_hit(first_number + out.missed[k]));
  b.traced.write(traced);
  cache.store(b.traced, b.hits);
  out.finals = b.hits.read();
  return out;
}

}  // namespace

TEST_CASE("an exact table answers what a std::unordered_map has, and nothing else") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Buffers buffers(context);
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "concurrent", "open"})) {
    CAPTURE(kind.text());
    for (const uint32_t hash : {1u, 2u, 3u}) {
      CacheConfig config = table_of(kind, "exact");
      config.hash_method = hash;
      kernels::RayCache cache(context, config, 600, 3);
      std::unordered_map<std::string, std::vector<uint32_t>> stored;  // the hits of each key
      size_t wrong = 0, lost = 0, answered = 0;
      for (uint32_t round = 0; round < 4; ++round) {
        const Batch asked = batch_of(round + 10, 3);
        const Round result = run(cache, buffers, asked, 1000 * round);
        std::vector<bool> missed(batch, false);
        for (const uint32_t i : result.missed) missed[i] = true;
        for (uint32_t i = 0; i < batch; ++i) {
          const auto found = stored.find(exact_key(asked.rays[i], asked.left[i], asked.regions[i]));
          if (missed[i]) {
            lost += found != stored.end();
            wrong += result.answers[i].triangle != kernels::no_triangle;
            wrong += result.finals[i].triangle != made_hit(1000 * round + i).triangle;
            continue;
          }
          ++answered;
          const kernels::Hit hit = result.finals[i];
          wrong += found == stored.end() || std::count(found->second.begin(), found->second.end(), hit.triangle) == 0 ||
                   hit.t != made_hit(hit.triangle).t || hit.u != 0 || result.answers[i].triangle != hit.triangle;
        }
        for (const uint32_t i : result.missed)
          stored[exact_key(asked.rays[i], asked.left[i], asked.regions[i])].push_back(1000 * round + i);
      }
      CHECK(wrong == 0);
      CHECK(answered > batch);
      // An open table writes over entries of the same slot, and the Morton hash puts many into one.
      if (kind != "open") CHECK(lost == 0);
      const kernels::RayCacheStatistics s = cache.statistics();
      CHECK(s.look_ups == 4 * batch);
      CHECK(s.hits == answered);
      CHECK(s.entries == 3 * ((1 << 15) / 3 / (kind == "concurrent" ? 8 : 1) * (kind == "concurrent" ? 8 : 1)));
    }
  }
}

TEST_CASE("frames, places, purging and clearing decide what still answers") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Buffers buffers(context);
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "concurrent", "open"})) {
    CAPTURE(kind.text());
    kernels::RayCache cache(context, table_of(kind, "quantised"), 600, 2);
    const Batch asked = batch_of(20, 2);
    const auto misses_now = [&] { return run(cache, buffers, asked, 0).missed.size(); };
    cache.place_region(0, {0, 0, 0});
    cache.place_region(1, {0, 0, 0});
    CHECK(misses_now() == batch);
    const size_t missed_again = misses_now();
    // No work-item waits for the lock of an open table: on a GPU, rays of one key that ask at a time miss.
    const size_t few = kind == "open" ? batch / 2 : missed_again;
    CHECK(missed_again < (kind == "open" ? batch / 2 : batch / 20));
    cache.next_frame();
    cache.place_region(0, {0.05, 0, 0});  // less than a step
    CHECK(misses_now() <= few);
    cache.next_frame();
    cache.place_region(0, {5, 0, 0});
    const size_t of_region = static_cast<size_t>(std::count(asked.regions.begin(), asked.regions.end(), 0u));
    const size_t moved = misses_now();
    CHECK(moved >= of_region);
    CHECK(moved <= of_region + few);
    cache.next_frame();
    cache.next_frame();
    cache.purge(2);  // nothing was asked in these frames
    const size_t purged = misses_now();
    CHECK((kind == "open" ? purged <= few : purged == batch));
    CHECK(misses_now() <= few);
    cache.clear();
    CHECK(cache.statistics().used == 0);
    CHECK(misses_now() == batch);
  }
}

TEST_CASE("a quantised table with the rays' own points finds what the tracer finds") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Buffers b(context);
  const std::vector<float> corners = soup(60, 10, 8, 3);
  kernels::Bvh bvh(context, corners, {.reach = 20});
  CacheConfig config = table_of("concurrent", "quantised");
  config.hit_point = "own";
  config.division = 4000;
  kernels::RayCache cache(context, config, bvh);
  // All rays leave one point; those of the second batch differ from those of the first by less than a cell.
  std::vector<kernels::Ray> rays = rays_in_cube(batch, 10, 7);
  for (kernels::Ray& ray : rays) std::fill(ray.origin, ray.origin + 3, 0.25f);
  size_t answered = 0, wrong = 0;
  for (int round = 0; round < 2; ++round) {
    b.rays.write(rays);
    const kernels::RayCache::Misses& misses = cache.look_up(b.rays, batch, b.hits);
    answered += batch - misses.count;
    bvh.nearest(misses.rays, misses.count, b.traced);
    cache.store(b.traced, b.hits);
    const std::vector<kernels::Hit> hits = b.hits.read();
    for (size_t i = 0; i < batch; ++i) {
      const Nearest expected = nearest_of(corners, rays[i]);
      // A ray that passes a triangle within a cell may get the hit of its neighbour.
      wrong += expected.certain && differs(hits[i], expected);
    }
    for (kernels::Ray& ray : rays) ray.direction[0] = std::nextafter(ray.direction[0], 0.0f);
  }
  CHECK(answered > batch / 2);
  CHECK(answered <= batch);
  CHECK(wrong <= 2);
}

TEST_CASE("faults of a user of RayCache: tables, batches, order of calls") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto made = [&](const CacheConfig& config, size_t triangles, uint32_t regions) {
    return message_of<kernels::Error>([&] { kernels::RayCache(context, config, triangles, regions); });
  };
  CacheConfig config = table_of("concurrent", "quantised");
  CHECK(contains(made(config, 1, 0), "at least one region"));
  CHECK(contains(made(config, 1, 1 << 12), "too small"));
  config.hit_point = "own";
  CHECK(contains(made(config, 1, 1), "needs the Bvh"));
  config.kind = "none";
  CHECK(contains(made(config, 1, 1), "is no table"));
  kernels::RayCache cache(context, table_of("open", "exact"), 1);
  const Buffers b(context);
  CHECK(contains(message_of<kernels::Error>([&] { cache.store(b.traced, b.hits); }), "without a look_up()"));
  CHECK(contains(message_of<kernels::Error>([&] { cache.look_up(b.rays, batch + 1, b.hits); }), "RayCache: rays"));
  CHECK(contains(message_of<kernels::Error>([&] { cache.place_region(1, {}); }), "region 1 of 1"));
  CHECK(cache.look_up(b.rays, 0, b.hits).count == 0);
  cache.store(b.traced, b.hits);
}
