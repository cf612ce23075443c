// SPDX-License-Identifier: Apache-2.0
// The public RayCache where rays of one key come together, and where triangles move: which rays must be traced, by maps
// of the host, and what the others get.
#include <doctest/doctest.h>

#include <cstring>
#include <map>
#include <set>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/soup.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/ray_cache.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;
using wavetracer::CacheConfig;
using wavetracer::CacheKind;

namespace {

constexpr uint32_t crowd = 500, triangles = 40;

CacheConfig crowd_table(CacheKind kind, wavetracer::CacheKey key, wavetracer::CacheHitPoint point) {
  CacheConfig config;
  config.kind = kind;
  config.key = key;
  config.hit_point = point;
  config.division = 4000;
  config.buffer_size = 1 << 14;
  config.readers_number = 1000;  // no entry wears out
  config.innerframe = true;
  return config;
}

struct KindAndKey {
  CacheKind kind;
  bool exact;
};
constexpr KindAndKey exact_or_not[] = {{"chained", true}, {"concurrent", false}, {"open", true}};

// A user's buffers for one batch.
struct Crowd {
  explicit Crowd(const kernels::Context& context)
      : rays(context.buffer<kernels::Ray>(crowd)),
        hits(context.buffer<kernels::Hit>(crowd)),
        traced(context.buffer<kernels::Hit>(crowd)),
        left(context.buffer<uint32_t>(crowd)) {}
  kernels::Buffer<kernels::Ray> rays;
  kernels::Buffer<kernels::Hit> hits, traced;
  kernels::Buffer<uint32_t> left;
};

// A hit that a tracer of the user's may find, which names the ray.
kernels::Hit named_hit(uint32_t i) { return {1.0f + static_cast<float>(i), i % triangles, 0.5f, 0.25f}; }

std::vector<uint32_t> traced_by_name(const Crowd& b, const kernels::RayCache::Misses& misses) {
  const std::vector<uint32_t> listed = misses.indices.read(0, misses.count);
  std::vector<kernels::Hit> hits;
  for (const uint32_t i : listed) hits.push_back(named_hit(i));
  b.traced.write(hits);
  return listed;
}

bool same_line(const kernels::Ray& a, const kernels::Ray& b) {
  return std::memcmp(a.origin, b.origin, sizeof a.origin) == 0 &&
         std::memcmp(a.direction, b.direction, sizeof a.direction) == 0;
}

// A batch in which rays come again; a few of them are exactly the same ray.
std::vector<kernels::Ray> repeated_rays() {
  const std::vector<kernels::Ray> pool = rays_in_cube(60, 10, 4);
  Numbers numbers(9);
  std::vector<kernels::Ray> out;
  for (size_t i = 0; i < crowd; ++i) out.push_back(pool[numbers.below(60)]);
  return out;
}

}  // namespace

TEST_CASE("one ray of each key is traced, the first one, and the others have its hit") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Crowd b(context);
  const std::vector<kernels::Ray> rays = repeated_rays();
  for (const auto& [kind, exact] : exact_or_not) {
    CAPTURE(kind.text());
    CAPTURE(exact);
    CacheConfig config = crowd_table(kind, "quantised", "cached");
    if (exact) config.key = "exact";
    kernels::RayCache cache(context, config, triangles);
    b.rays.write(rays);
    std::map<std::string, uint32_t> first;  // the first ray of each key, by its bits
    std::vector<uint32_t> leader;
    for (uint32_t i = 0; i < crowd; ++i) {
      const std::string bits(reinterpret_cast<const char*>(&rays[i]), sizeof rays[i]);
      leader.push_back(first.emplace(bits, i).first->second);
    }
    const std::vector<uint32_t> listed = traced_by_name(b, cache.look_up(b.rays, crowd, b.hits));
    const std::set<uint32_t> expected(leader.begin(), leader.end());
    CHECK(std::vector<uint32_t>(expected.begin(), expected.end()) == listed);
    CHECK(cache.store(b.traced, b.hits).count == 0);
    size_t wrong = 0;
    const std::vector<kernels::Hit> hits = b.hits.read();
    for (uint32_t i = 0; i < crowd; ++i)
      wrong += hits[i].triangle != named_hit(leader[i]).triangle || hits[i].t != named_hit(leader[i]).t;
    CHECK(wrong == 0);
    const kernels::RayCacheStatistics s = cache.statistics();
    CHECK(s.hits == 0);
    CHECK(s.shared == crowd - expected.size());
    // The next batch is answered by the table, but for open ones: entries may lack a place there, and a ray that finds
    // its entry locked is not answered, which happens where many work-items ask at once.
    const size_t missed = cache.look_up(b.rays, crowd, b.hits).count;
    CHECK(missed <= (kind == "open" ? expected.size() / 2 + cache.statistics().conflicts : 0));
  }
}

TEST_CASE("rays of a cell share what the rules of a look-up allow; the others are listed once more") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Crowd b(context);
  const std::vector<float> corners = soup(triangles, 10, 8, 3);
  kernels::Bvh bvh(context, corners, {.reach = 20});
  CacheConfig config = crowd_table("concurrent", "quantised", "own");
  config.division = 25;  // cells of a few degrees, in which many rays pass the edge of a triangle
  kernels::RayCache cache(context, config, bvh);
  std::vector<kernels::Ray> rays = rays_in_cube(crowd, 10, 7);
  for (kernels::Ray& ray : rays) std::fill(ray.origin, ray.origin + 3, 0.25f);
  b.rays.write(rays);
  std::vector<bool> traced(crowd, false);
  std::vector<size_t> rounds;
  for (const auto* m = &cache.look_up(b.rays, crowd, b.hits); m->count > 0; m = &cache.store(b.traced, b.hits)) {
    const std::vector<kernels::Ray> given = m->rays.read(0, m->count);
    const std::vector<uint32_t> listed = m->indices.read(0, m->count);
    for (size_t k = 0; k < listed.size(); ++k) {
      CHECK(same_line(given[k], rays[listed[k]]));
      CHECK_FALSE(traced[listed[k]]);
      traced[listed[k]] = true;
    }
    bvh.nearest(m->rays, m->count, b.traced);
    rounds.push_back(m->count);
  }
  REQUIRE(rounds.size() == 2);
  const kernels::RayCacheStatistics s = cache.statistics();
  CHECK(s.shared > 20);
  CHECK(s.shared == crowd - rounds[0] - rounds[1]);
  const std::vector<kernels::Hit> hits = b.hits.read();
  size_t wrong = 0, off_plane = 0;
  for (size_t i = 0; i < crowd; ++i) {
    if (traced[i]) {
      const Nearest expected = nearest_of(corners, rays[i]);
      wrong += expected.certain && differs(hits[i], expected);
    } else if (!hits[i].missed()) {  // on its own line, and in the plane of the triangle
      const float* c = corners.data() + size_t{9} * hits[i].triangle;
      const Vec a = vec_of(c), across = cross(minus(vec_of(c + 3), a), minus(vec_of(c + 6), a));
      Vec point{};
      for (size_t axis = 0; axis < 3; ++axis)
        point[axis] = double{rays[i].origin[axis]} + double{hits[i].t} * double{rays[i].direction[axis]};
      off_plane += std::abs(dot(minus(point, a), across)) > 1e-3 * std::sqrt(dot(across, across));
    }
  }
  CHECK(wrong == 0);
  CHECK(off_plane == 0);
}

TEST_CASE("with cached points, rays that share a hit become the ray that was traced") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Crowd b(context);
  CacheConfig config = crowd_table("chained", "quantised", "cached");
  config.division = 4;
  kernels::RayCache cache(context, config, triangles);
  const std::vector<kernels::Ray> rays = rays_in_cube(crowd, 10, 8);
  b.rays.write(rays);
  const std::vector<uint32_t> listed = traced_by_name(b, cache.look_up(b.rays, crowd, b.hits));
  CHECK(listed.size() <= 64);
  CHECK(cache.store(b.traced, b.hits).count == 0);
  const std::vector<kernels::Ray> after = b.rays.read();
  const std::vector<kernels::Hit> hits = b.hits.read();
  size_t wrong = 0;
  for (size_t i = 0; i < crowd; ++i) {
    const auto leader = static_cast<uint32_t>(std::lround(hits[i].t - 1));
    bool one_cell = same_line(after[i], rays[leader]);
    for (size_t axis = 0; axis < 3; ++axis)
      one_cell &= std::floor((rays[i].direction[axis] + 1) * 2) == std::floor((rays[leader].direction[axis] + 1) * 2);
    wrong += !one_cell;
  }
  CHECK(wrong == 0);
}

TEST_CASE("entries of objects that have moved do not answer, whether rays left or met them") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const Crowd b(context);
  std::vector<uint32_t> objects(triangles, kernels::no_object);
  for (uint32_t i = 10; i < triangles; ++i) objects[i] = i % 3;
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "concurrent"})) {
    CAPTURE(kind.text());
    CacheConfig config = crowd_table(kind, "quantised", "cached");
    config.division = 200000;
    config.scope = "all";
    config.innerframe = false;
    kernels::RayCache cache(context, config, triangles, 1, objects);
    const std::vector<kernels::Ray> rays = rays_in_cube(crowd, 10, 5);
    std::vector<uint32_t> left;
    for (uint32_t i = 0; i < crowd; ++i) left.push_back(i % 5 ? i * 7 % triangles : kernels::no_triangle);
    b.rays.write(rays);
    b.left.write(left);
    traced_by_name(b, cache.look_up(b.rays, crowd, b.hits, &b.left));
    cache.store(b.traced, b.hits);
    REQUIRE(cache.look_up(b.rays, crowd, b.hits, &b.left).count == 0);
    cache.next_frame();
    cache.move_object(1);
    std::vector<uint32_t> expected;
    const auto moved = [&](uint32_t triangle) { return triangle != kernels::no_triangle && objects[triangle] == 1; };
    for (uint32_t i = 0; i < crowd; ++i)
      if (moved(left[i]) || moved(named_hit(i).triangle)) expected.push_back(i);
    CHECK(traced_by_name(b, cache.look_up(b.rays, crowd, b.hits, &b.left)) == expected);
    CHECK(cache.statistics().stale == expected.size());
    cache.store(b.traced, b.hits);
    cache.next_frame();  // nothing has moved since
    CHECK(cache.look_up(b.rays, crowd, b.hits, &b.left).count == 0);
  }
}

TEST_CASE("faults of a user of groups and objects") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const std::vector<uint32_t> three{0, 1, kernels::no_object}, far{0, 3, 0};
  const auto made = [&](const CacheConfig& config, const std::vector<uint32_t>& objects) {
    return message_of<kernels::Error>([&] { kernels::RayCache(context, config, size_t{3}, 1, objects); });
  };
  CacheConfig config = crowd_table("open", "quantised", "cached");
  CHECK(contains(made(config, three), "objects were given"));
  config.scope = "all";
  CHECK(contains(made(config, {}), "needs the objects"));
  CHECK(contains(made(config, {0, 1}), "objects of 2 triangles, of 3"));
  CHECK(contains(made(config, far), "triangle 1 belongs to object 3"));
  kernels::RayCache cache(context, config, size_t{3}, 1, three);
  CHECK(contains(message_of<kernels::Error>([&] { cache.move_object(2); }), "object 2 of 2"));
  config.key = "exact";
  CHECK(contains(made(config, three), "does not notice what moves"));
  config.scope = "static";
  config.kind = "thesis";
  CHECK(contains(made(config, {}), "no key of the thesis' tables"));
  config = crowd_table("chained", "quantised", "cached");
  config.load_factor = 0;
  CHECK(contains(made(config, {}), "load_factor = 0: it is 1 to 64"));
}
