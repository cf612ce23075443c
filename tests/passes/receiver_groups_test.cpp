// SPDX-License-Identifier: Apache-2.0
// Groups of receivers: those of links alone have places, each one, near its fellows; links that vanish and come back,
// and others in their place, leave nothing of frames before.
#include "passes/receiver_groups.hpp"

#include <doctest/doctest.h>

#include <set>

#include "passes/on_device.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::vector<EndState> some_receivers(uint32_t count) {
  Random random(5);
  std::vector<EndState> out(count);
  for (EndState& receiver : out) receiver.position_m = random.in_cube(100);
  return out;
}

// The links that the masks of the groups say.
std::set<Link> links_in(const ReceiverGroups& groups, uint32_t transmitters) {
  const std::vector<uint32_t> order = groups.order.read(0, groups.capacity);
  const uint32_t count = groups.capacity / ReceiverGroups::size;
  const std::vector<uint16_t> words = groups.links.read(0, size_t{transmitters} * count);
  std::set<Link> out;
  for (uint32_t tx = 0; tx < transmitters; ++tx)
    for (uint32_t place = 0; place < groups.capacity; ++place)
      if (words[tx * count + place / 16] >> place % 16 & 1) CHECK(out.insert({tx, order[place]}).second);
  return out;
}

}  // namespace

TEST_CASE("the receivers of links are in groups, whichever links there were before") {
  const std::vector<EndState> receivers = some_receivers(300);
  std::vector<Link> all, few;
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t rx = 0; rx < 300; ++rx) {
      all.push_back({tx, rx});
      if (rx % 7 == tx) few.push_back({tx, rx});
    }
  ReceiverGroups groups;
  for (const std::vector<Link>& links : {all, few, {}, few, {}, all, {{1, 299}}}) {
    groups.set(context(), receivers, 2, links);
    std::set<uint32_t> linked;
    for (const Link& link : links) linked.insert(link.rx);
    CHECK(groups.capacity == (linked.size() + 127) / 128 * 128);
    if (!links.empty()) CHECK(links_in(groups, 2) == std::set<Link>(links.begin(), links.end()));
  }
}

TEST_CASE("places are those of the receivers, and boxes hold them") {
  std::vector<EndState> receivers = some_receivers(500);
  std::vector<Link> links;
  for (uint32_t rx = 3; rx < 500; rx += 2) links.push_back({0, rx});
  ReceiverGroups groups;
  for (int round = 0; round < 2; ++round) {
    groups.set(context(), receivers, 1, links);
    const uint32_t capacity = groups.capacity, count = capacity / 16;
    const std::vector<uint32_t> order = groups.order.read(0, capacity);
    const std::vector<float> places = groups.places.read(0, 3 * size_t{capacity}),
                             boxes = groups.boxes.read(0, 6 * count);
    for (uint32_t place = 0; place < links.size(); ++place)
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<float>(receivers[order[place]].position_m[static_cast<int>(axis)]);
        CHECK(places[axis * capacity + place] == at);
        CHECK(std::abs(at - boxes[axis * count + place / 16]) <= boxes[(3 + axis) * count + place / 16]);
      }
    for (EndState& receiver : receivers) receiver.position_m *= 0.5;  // they move
  }
}
