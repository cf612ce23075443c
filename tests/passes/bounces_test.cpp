// SPDX-License-Identifier: Apache-2.0
// bounces: the same sequences, quarters, ages, ends and counts as the loop of trace, scan and interact, in a moving
// world, for any number of interactions; and an overflow that is reported.
#include "passes/bounces.hpp"

#include <map>

#include "passes/interact.hpp"
#include "passes/scan.hpp"
#include "passes/traffic.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Chain = std::vector<uint32_t>;

// The results of a batch: for each sequence, root first, its quarters and its age; the ends of the samples, by their
// sequences; the numbers of hits, with the number of rays that made them.
struct Discovered {
  std::map<Chain, std::pair<uint32_t, uint32_t>> sequences;
  std::vector<Chain> ends;
  std::vector<uint32_t> ended;
  bool operator==(const Discovered&) const = default;
};

Chain chain_of(const std::vector<uint64_t>& table, uint32_t node) {
  Chain out;
  for (; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
    out.insert(out.begin(), static_cast<uint32_t>(table[node]));
  out.insert(out.begin(), node);
  return out;
}

RayQueue with_samples(const std::vector<Ray>& rays) {
  const RayQueue plain = upload(rays);
  RayQueue queue = make_ray_queue(context(), rays.size(), "rays", WT_RAY_PLANES + 1);
  context().copy(plain.planes, queue.planes, std::min(plain.planes.bytes(), queue.planes.bytes()));
  std::vector<float> samples;
  for (uint32_t i = 0; i < rays.size(); ++i) samples.push_back(std::bit_cast<float>(i));
  queue.planes.write(samples, size_t{WT_RAY_SAMPLE} * queue.capacity);
  queue.count = plain.count;
  return queue;
}

Discovered outcome(Sequences& set, const gpu::Buffer<uint32_t>& ends, std::vector<uint32_t> ended) {
  Discovered out;
  out.ended = std::move(ended);
  const std::vector<uint64_t> table = set.table().read();
  const std::vector<uint32_t> quarters = set.quarters().read(), ages = set.ages()->read();
  for (uint32_t node = 0; node < table.size(); ++node)
    if (table[node] != WT_EMPTY) out.sequences[chain_of(table, node)] = {quarters[node], ages[node]};
  for (const uint32_t node : ends.read()) out.ends.push_back(chain_of(table, node));
  return out;
}

gpu::Buffer<uint32_t> roots_of(const std::vector<Ray>& rays) {
  std::vector<uint32_t> roots;
  for (const Ray& ray : rays) roots.push_back(ray.node & ~WT_QUARTER_BITS);
  return context().buffer(roots, "ends");
}

Discovered at_once(const DeviceScene& scene, const std::vector<Ray>& rays, uint32_t interactions) {
  Sequences set(context(), 1 << 16, true);
  set.begin_frame();
  gpu::Buffer<uint32_t> ends = roots_of(rays);
  Bounces(context(), scene, true, true)(scene, with_samples(rays), interactions, set.trie(), &ends);
  const wt_counters after = set.counters().read(Stage::trace);
  CHECK(after.trie_overflow == 0);
  return outcome(set, ends, {after.ended, after.ended + interactions + 1});
}

Discovered depth_by_depth(const DeviceScene& scene, const std::vector<Ray>& rays, uint32_t interactions) {
  Sequences set(context(), 1 << 16, true);
  set.begin_frame();
  gpu::Buffer<uint32_t> ends = roots_of(rays);
  RayQueue queue = with_samples(rays), next = with_samples(rays);
  HitList hits = make_hit_list(context(), rays.size());
  Trace trace(context(), scene, shapes().front());
  Scan scan(context());
  Interact interact(context(), {.ages = true, .samples = true});
  std::vector<uint32_t> ended(interactions + 1);
  for (uint32_t depth = 0; depth < interactions && queue.count > 0; ++depth) {
    trace(scene, queue, hits);
    const uint32_t alive = scan(hits.block_hits, hits.blocks(queue.count));
    ended[depth] = queue.count - alive;
    interact(scene, queue, hits, alive, set.trie(), {.reflected = &next, .ends = &ends});
    std::swap(queue, next);
  }
  ended[interactions] = queue.count;
  return outcome(set, ends, ended);
}

std::vector<Ray> launch_rays(uint32_t count, uint32_t instances) {
  std::vector<Ray> rays = rays_in(8, count, 0, 5);
  for (uint32_t i = 0; i < rays.size(); ++i) {
    rays[i].surface = i % 11 == 0 ? WT_OWN | i % instances : WT_NONE;
    rays[i].node = wt_with_quarter(WT_ROOT | i % 3, i);
  }
  return rays;
}

}  // namespace

TEST_CASE("what the loop over depths enters, in one launch") {
  const Traffic traffic(9, 71);
  const DeviceScene scene = traffic.upload();
  const uint32_t many = as_many(3000, 200);
  for (const uint32_t count : {1u, 127u, 129u, many})
    for (const uint32_t interactions : {1u, 2u, 6u}) {
      CAPTURE(count);
      CAPTURE(interactions);
      const std::vector<Ray> rays = launch_rays(count, 9);
      const Discovered loop = depth_by_depth(scene, rays, interactions);
      CHECK(at_once(scene, rays, interactions) == loop);
      if (count == many) CHECK(loop.sequences.size() > many / 30 * interactions);
      if (count == many) CHECK(loop.ended[interactions] > many / 150);
    }
}

TEST_CASE("a set that is too small says so") {
  const Traffic traffic(2, 3);
  const DeviceScene scene = traffic.upload();
  Sequences set(context(), 64);
  Bounces bounces(context(), scene, false, false);
  bounces(scene, upload(launch_rays(3000, 2)), 6, set.trie(), nullptr);
  CHECK(set.overflowed());
}
