// SPDX-License-Identifier: Apache-2.0
// The directions that frames launch, and the depth of their rays: counted direction by direction.
#include "simulation/launch_share.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "simulation/tracing_depth.hpp"

using namespace wavetracer;

namespace {

// The directions that a launch of this share sends, one after the other.
std::vector<uint64_t> directions(const Launch& launch) {
  std::vector<uint64_t> out;
  for (uint64_t i = launch.share.phase; i < launch.rays; i += launch.share.stride) out.push_back(i);
  return out;
}

}  // namespace

TEST_CASE("a cold frame launches all directions, and as many warm ones as the stride launch each of them once") {
  for (const uint64_t rays : {1, 7, 1000, 12345})
    for (const std::optional<uint64_t> refresh : {std::optional<uint64_t>(), {1}, {300}, {20000}}) {
      CAPTURE(rays);
      CAPTURE(refresh.value_or(0));
      Launch cold;
      cold.rays = rays;
      cold.share = share_of(rays, refresh, 0);
      CHECK(directions(cold).size() == rays);
      const uint64_t stride = share_of(rays, refresh, 1).stride;
      std::multiset<uint64_t> launched;
      for (uint64_t frame = 1; frame <= stride; ++frame) {
        const Launch launch{.who = {{0, {}}, {1, {}}}, .rays = rays, .share = share_of(rays, refresh, frame)};
        const std::vector<uint64_t> each = directions(launch);
        CHECK(each.size() == launch.rays_each());
        CHECK(launch.total() == 2 * each.size());
        launched.insert(each.begin(), each.end());
      }
      REQUIRE(launched.size() == rays);
      CHECK(std::set(launched.begin(), launched.end()).size() == rays);
    }
}

TEST_CASE("a few warm frames in a row spread evenly over the directions that they share") {
  constexpr uint64_t rays = 100000, frames = 10;
  std::vector<uint64_t> phases;
  for (uint64_t frame = 1; frame <= frames; ++frame) phases.push_back(share_of(rays, 1000, frame).phase);
  std::ranges::sort(phases);
  uint64_t widest = phases.front() + 100 - phases.back();
  for (size_t i = 1; i < phases.size(); ++i) widest = std::max(widest, phases[i] - phases[i - 1]);
  // The sum is 100, and 10 would be uniform; by the three-gap theorem the widest gap of golden steps is below 1.7 times
  // that.
  CHECK(widest <= 17);
}

TEST_CASE("listeners launch fewer rays, and nobody follows or sorts them") {
  TraceConfig trace;
  const auto rays = [&](uint64_t all, std::optional<uint64_t> asked) {
    trace.rays = all;
    trace.diffraction_rays = asked;
    return listener_rays(trace);
  };
  CHECK(rays(50000, {}) == 50000);
  CHECK(rays(500000, {}) == 100000);
  CHECK(rays(5000000, {}) == 500000);
  CHECK(rays(5000000, 70) == 70);
  CHECK(rays(5000, 70000) == 5000);
  trace = {};
  trace.rays = 20000;
  CHECK(frame_launches(trace, {{0, {}}}, {}, 0).size() == 1);
  const std::vector<Launch> both = frame_launches(trace, {{0, {}}}, {{1, {}}, {2, {}}}, 3);
  REQUIRE(both.size() == 2);
  CHECK((both[0].followed && both[0].sorted));
  CHECK_FALSE((both[1].followed || both[1].sorted));
  CHECK(both[1].who.size() == 2);
  CHECK(few_directions(1000).stride == 1);
  CHECK(few_directions(1 << 20).stride == 256);
}

TEST_CASE("how deep sequences and rays go, for every set of kinds of interactions") {
  for (uint32_t bits = 0; bits < 16; ++bits)
    for (uint32_t depth = 0; depth <= 3; ++depth) {
      CAPTURE(bits);
      CAPTURE(depth);
      TraceConfig trace;
      trace.max_depth = depth;
      trace.reflection = bits & 1;
      trace.diffraction = bits & 2;
      trace.transmission = bits & 4;
      trace.scattering = bits & 8;
      trace.max_transmissions = 2;
      const TracingDepth found = tracing_depth(trace);
      CHECK(found.reflections == (trace.reflection ? depth : 0));
      // A wedge and a tile are found by the one surface that they lie on.
      const uint32_t sequences = trace.reflection ? depth : trace.diffraction || trace.scattering ? 1 : 0;
      CHECK(found.sequences == std::min(sequences, depth));
      CHECK(found.interactions == (found.sequences > 0 && trace.transmission ? depth : found.sequences));
      CHECK(found.transmissions <= 2);
      CHECK((found.transmissions > 0) == (trace.transmission && found.sequences > 0 && depth > 1));
    }
}
