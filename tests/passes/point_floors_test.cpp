// SPDX-License-Identifier: Apache-2.0
// point_floors: the nearest ends of each tile against a loop over all ends; and the prefixes that point_prefixes leaves
// out with the floors: each is too weak with every other end of a wanted link, and others that are as weak are few.
#include "passes/point_floors.hpp"

#include "passes/point_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double rounding = 1e-6;

std::vector<double> some_powers(uint32_t tiles) {
  std::vector<double> out;
  for (uint32_t tile = 0; tile < tiles; ++tile) out.push_back(1e-6 * (1 + tile % 5));
  return out;
}

std::vector<double> squares(const std::vector<EndState>& ends, const glm::dvec3& p) {
  std::vector<double> out;
  for (const EndState& end : ends) out.push_back(glm::dot(end.position_m - p, end.position_m - p));
  return out;
}

double nearest_but(std::vector<double> values, uint32_t except) {
  if (except < values.size()) values[except] = INFINITY;
  return *std::ranges::min_element(values);
}

// The largest gain of a path with this prefix, if the other way is straight.
double best(const PointWorld& world, uint32_t end, const glm::dvec3& tile, double power, double length_m) {
  double out = 0;
  for (const Link& link : world.links) {
    const auto gain = [&](const EndState& other) {
      const glm::dvec3 way = other.position_m - tile;
      return power / (length_m * length_m * glm::dot(way, way));
    };
    if (link.tx == end) out = std::max(out, gain(world.receivers[link.rx]));
    if (link.rx == world.receiver_of(end)) out = std::max(out, gain(world.transmitters[link.tx]));
  }
  return out;
}

}  // namespace

TEST_CASE("point_floors: what each tile needs, and no prefix of a path above the floor is left out") {
  PointWorld world;
  world.add_vehicle();
  PointsOnDevice device(world, 2, 1.5);
  const std::vector<double> powers = some_powers(device.tiles.size());
  const PointPrefixMap all = [&] {
    PointPrefixes pass(context(), 3, 2);
    pass(device.scene, device.buffers, device.ends, device.found(), 0, device.tiles.size(), device.set.counters());
    return prefixes_of(pass.list().rows);
  }();
  REQUIRE(all.size() > 500);
  for (const bool beside_edge : {false, true})
    for (const double floor : {1e-9, 1e-8, 1e-7}) {
      CAPTURE(floor);
      PointFloors floors(context(), floor, powers, beside_edge);
      floors(device.scene, device.buffers, device.ends);
      const auto records = floors.list().read(0, device.tiles.size());
      PointPrefixes pass(context(), 3, 2);
      pass(device.scene, device.buffers, device.ends, device.found(), 0, device.tiles.size(), device.set.counters(),
           &floors.list());
      const PointPrefixMap left = prefixes_of(pass.list().rows);
      const double needed = floor / (beside_edge ? WT_MOST_OF_EDGE : 1.0);
      size_t weak = 0, kept_weak = 0;
      for (const auto& [prefix, points] : all) {
        const auto& [end, mirrors, tile] = prefix;
        const glm::dvec3 centre = points.back();
        const std::vector<double> to_senders = squares(world.transmitters, centre),
                                  to_receivers = squares(world.receivers, centre);
        const double of_tile = needed * (1 - rounding) / powers[tile];
        const wt_point_floor& record = records[tile];
        CHECK(record.sent[0] == doctest::Approx(of_tile * nearest_but(to_senders, WT_NONE)).epsilon(1e-12));
        CHECK(record.sent[1] == doctest::Approx(of_tile * nearest_but(to_senders, record.sender)).epsilon(1e-12));
        CHECK(record.heard[0] == doctest::Approx(of_tile * nearest_but(to_receivers, WT_NONE)).epsilon(1e-12));
        CHECK(record.heard[1] == doctest::Approx(of_tile * nearest_but(to_receivers, record.receiver)).epsilon(1e-12));
        double length_m = glm::distance(world.end(end).position_m, points[0]);
        for (size_t k = 1; k < points.size(); ++k) length_m += glm::distance(points[k - 1], points[k]);
        const bool may_matter = best(world, end, centre, powers[tile], length_m) >= needed;
        weak += !may_matter;
        if (may_matter) CHECK(left.contains(prefix));
        kept_weak += !may_matter && left.contains(prefix);
      }
      CHECK(left.size() + weak - kept_weak == all.size());
      if (floor == 1e-7) CHECK(kept_weak < weak);
    }
}
