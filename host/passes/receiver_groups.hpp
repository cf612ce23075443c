// SPDX-License-Identifier: Apache-2.0
// The receivers of links in groups of 16 that are close together, and areas of 16 groups, each in its box: receivers
// that a sequence surely does not reach are skipped area by area, and group by group.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct ReceiverGroups {
  static constexpr uint32_t size = 16;     // places of a group, one each for a receiver; and groups of an area
  static constexpr uint32_t together = 8;  // boxes that are tested at once; their numbers are multiples of it
  gpu::Buffer<uint32_t> order;             // the receiver at each place
  gpu::Buffer<float> places;               // three planes: x, y and z, recentred metres
  gpu::Buffer<float> boxes;                // six planes: for each group the middle of its box, and half of its size
  gpu::Buffer<float> areas;                // the same for each area; added areas have no groups
  gpu::Buffer<uint16_t> links;             // bit b of word tx * groups + g: place 16 g + b
  uint32_t capacity = 0;                   // places

  // receivers: in recentred metres, all of them finite. Data that has not changed since the last call is kept.
  void set(gpu::Context& context, const std::vector<EndState>& receivers, uint32_t transmitter_count,
           const std::vector<Link>& links);

 private:
  std::vector<uint32_t> linked_;      // the receivers of links, in their order
  std::vector<float> positions_;      // positions of these receivers, three values each
  std::vector<uint32_t> place_of_;    // by receiver: its place, if it has a link
  std::vector<uint16_t> link_words_;  // the words of `links`

  bool moved(const std::vector<EndState>& receivers, const std::vector<Link>& links);
  void set_places(gpu::Context& context, size_t receivers);
};

// The links, a bit each: bit b of word tx * groups + g for the receiver whose place_of is 16 g + b.
template <class PlaceOf>
std::vector<uint16_t> link_bits(uint32_t transmitter_count, size_t groups, const std::vector<Link>& links,
                                const PlaceOf& place_of) {
  std::vector<uint16_t> words(transmitter_count * groups, 0);
  for (const Link& link : links) {
    const uint32_t place = place_of(link.rx);
    words[link.tx * groups + place / ReceiverGroups::size] |= static_cast<uint16_t>(1u << place % ReceiverGroups::size);
  }
  return words;
}

// The numbers of points, which have three coordinates each, group by group: halved along the longest side of their box
// until 16 are left. All areas and all groups except the last ones are full, and areas are halves of what they lie in.
std::vector<uint32_t> grouped(const std::vector<float>& positions);

}  // namespace wavetracer
