// SPDX-License-Identifier: Apache-2.0
// Launches of one, two and three dimensions: every ray is taken exactly once, and hits are the same for every shape.
// Groups of a curve's launch contain consecutive rays, which is the purpose of the thesis' mapped buffers.
#include "passes/launch_shape.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "passes/compact.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/curves.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::vector<LaunchShape> all_shapes() {
  std::vector<LaunchShape> shapes;
  for (const std::optional<uint32_t> local : std::vector<std::optional<uint32_t>>{{}, 1, 32, 64, 256}) {
    shapes.push_back({1, false, local});
    for (const unsigned dimensions : {2u, 3u})
      for (const bool curve : {false, true}) shapes.push_back({dimensions, curve, local});
  }
  return shapes;
}

// Computes wt_launch_index on the host.
uint64_t index_of(const LaunchShape& shape, const std::array<size_t, 3>& global, size_t x, size_t y, size_t z) {
  const auto X = static_cast<uint32_t>(x), Y = static_cast<uint32_t>(y), Z = static_cast<uint32_t>(z);
  const auto width = static_cast<uint32_t>(global[0]);
  const auto level = static_cast<unsigned>(std::bit_width(width)) - 1;
  if (shape.dimensions == 1) return x;
  if (!shape.curve) return (z * global[1] + y) * global[0] + x;
  if (shape.dimensions == 2)
    return (uint64_t{Y >> level} << (2 * level)) | device::wt_hilbert2_encode32(X, Y & (width - 1), level);
  return (uint64_t{Z >> level} << (3 * level)) | device::wt_hilbert3_encode32(X, Y, Z & (width - 1), level);
}

}  // namespace

TEST_CASE("every index is met once, by ranges that waste little") {
  for (const LaunchShape& shape : all_shapes())
    for (const size_t count : {size_t{1}, size_t{2}, size_t{100}, size_t{4096}, size_t{5000}, size_t{70001}}) {
      CAPTURE(shape.dimensions);
      CAPTURE(shape.curve);
      CAPTURE(shape.local_size.value_or(0));
      CAPTURE(count);
      const gpu::Range range = shape.range(count, 128);
      REQUIRE(range.dimensions == shape.dimensions);
      std::array<size_t, 3> global;
      for (size_t d = 0; d < 3; ++d)
        global[d] = (range.global[d] + range.local[d] - 1) / range.local[d] * range.local[d];
      const uint32_t local = shape.local_size.value_or(128);
      CHECK(range.local[0] * range.local[1] * range.local[2] == local);
      std::vector<uint8_t> met(count, 0);
      size_t twice = 0;
      for (size_t z = 0; z < global[2]; ++z)
        for (size_t y = 0; y < global[1]; ++y)
          for (size_t x = 0; x < global[0]; ++x) {
            const uint64_t i = index_of(shape, global, x, y, z);
            if (i < count && met[i]++) ++twice;
          }
      CHECK(twice == 0);
      CHECK(std::count(met.begin(), met.end(), 1) == static_cast<std::ptrdiff_t>(count));
      if (count > 4096) CHECK(global[0] * global[1] * global[2] < count + count / 8 + 64 * local);
    }
}

TEST_CASE("a square group of a curve's launch holds consecutive rays") {
  const LaunchShape shape{2, true, 64};
  const gpu::Range range = shape.range(65536, 128);
  for (size_t y0 = 0; y0 < 64; y0 += 8)
    for (size_t x0 = 0; x0 < 64; x0 += 8) {
      std::set<uint64_t> group;
      for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 8; ++x) group.insert(index_of(shape, range.global, x0 + x, y0 + y, 0));
      REQUIRE(*group.rbegin() - *group.begin() == 63);
    }
}

TEST_CASE("hits and the hits of blocks are the same for every launch shape") {
  const Scene scene = scene_of_triangles(random_soup(60, 10, 4, 11));
  const DeviceScene device = make_device_scene(context(), scene, false, 20);
  Random random(5);
  std::vector<Ray> rays(as_many(1003, 259));
  for (Ray& ray : rays) {
    const glm::dvec3 o = random.in_cube(12), d = random.direction();
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[static_cast<size_t>(axis)] = static_cast<float>(o[axis]);
      ray.direction[static_cast<size_t>(axis)] = static_cast<float>(d[axis]);
    }
  }
  const RayQueue queue = upload(rays);
  Compact compact(context());
  const uint32_t blocks = compact.blocks(queue.count);
  for (const TraceShape traversal : shapes()) {
    CAPTURE(name_of(traversal));
    std::vector<Hit> expected;
    std::vector<uint32_t> expected_blocks;
    std::vector<LaunchShape> launches{{1, false}};
    for (const unsigned dimensions : {1u, 2u, 3u})
      for (const bool curve : {false, true})
        if (dimensions > 1 || !curve) launches.push_back({dimensions, curve, dimensions == 3 ? 8u : 32u});
    for (const LaunchShape& launch : launches) {
      HitList hits = make_hit_list(context(), rays.size());
      Trace trace(context(), device, traversal, launch);
      trace(device, queue, hits);
      // bvh2 is the GPU's traversal: where its block differs from this device's, the fused counts are not those of
      // compact.
      if (!trace.counts_blocks())
        compact.count_blocks(hits.planes, size_t{WT_HIT_SURFACE} * hits.capacity, queue.count, hits.block_hits);
      const std::vector<Hit> found = download(hits, rays.size());
      const std::vector<uint32_t> counts = hits.block_hits.read(0, blocks);
      if (expected.empty()) {
        CHECK(misses(found) > 100);
        CHECK(misses(found) < 900);
        expected = found;
        expected_blocks = counts;
      }
      CHECK(found == expected);
      CHECK(counts == expected_blocks);
    }
  }
}
