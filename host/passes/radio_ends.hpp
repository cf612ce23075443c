// SPDX-License-Identifier: Apache-2.0
// Transmitters and receivers on the device: double4 records (position, instance), and receivers as float planes for the
// conservative rejection. Where paths are sought from both ends, receivers that do not send launch rays, too: they are
// called listeners. Positions are recentred metres; the instance is that of the vehicle that carries the end, -1
// without one.
#pragma once
#include <algorithm>
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/receiver_groups.hpp"
#include "passes/upload.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct RadioEnds {
  gpu::Buffer<double> transmitters, receivers;  // four doubles each; listeners follow the transmitters
  gpu::Buffer<float> receiver_planes;           // three planes of receiver_capacity
  gpu::Buffer<uint16_t> links;                  // bit b of word tx * (receiver_capacity / 16) + g: receiver 16 g + b
  std::vector<uint16_t> link_words;             // the words of `links`
  ReceiverGroups groups;
  uint32_t transmitter_count = 0, receiver_count = 0, receiver_capacity = 0;
  bool moved = true;                                      // since the frame before, or turned, or changed their speed
  std::vector<double> transmitter_words, receiver_words;  // the words of the buffers
  std::vector<float> plane_words;
};

// The links in the form of RadioEnds::links.
inline std::vector<uint16_t> link_masks(const RadioEnds& ends, const std::vector<Link>& links) {
  return link_bits(ends.transmitter_count, ends.receiver_capacity / 16, links,
                   [](uint32_t receiver) { return receiver; });
}

// Positions and the instances that carry them, in the form that wt_end_instance reads.
inline std::vector<double> end_quadruples(const std::vector<EndState>& ends) {
  std::vector<double> out;
  for (const EndState& end : ends)
    out.insert(out.end(), {end.position_m.x, end.position_m.y, end.position_m.z,
                           end.instance == no_instance ? -1.0 : static_cast<double>(end.instance)});
  return out;
}

// Writes the places of a frame's ends to the buffers of the frame before, where they are large enough.
inline void set_places(gpu::Context& context, RadioEnds& ends, const std::vector<EndState>& transmitters,
                       const std::vector<EndState>& receivers, const std::vector<uint32_t>& listeners) {
  ends.transmitter_count = static_cast<uint32_t>(transmitters.size());
  ends.receiver_count = static_cast<uint32_t>(receivers.size());
  ends.receiver_capacity = (ends.receiver_count + 15) / 16 * 16;
  std::vector<float> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (uint32_t i = 0; i < ends.receiver_capacity; ++i)
      planes.push_back(static_cast<float>(receivers[std::min(i, ends.receiver_count - 1)].position_m[axis]));
  std::vector<EndState> launching = transmitters;
  for (const uint32_t receiver : listeners) launching.push_back(receivers[receiver]);
  upload_changed(context, ends.transmitters, ends.transmitter_words, end_quadruples(launching), "transmitters");
  upload_changed(context, ends.receivers, ends.receiver_words, end_quadruples(receivers), "receivers");
  upload_changed(context, ends.receiver_planes, ends.plane_words, std::move(planes), "receiver planes");
}

// Writes the wanted links of ends whose places are set.
inline void set_links(gpu::Context& context, RadioEnds& ends, const std::vector<EndState>& receivers,
                      const std::vector<Link>& links) {
  ends.groups.set(context, receivers, ends.transmitter_count, links);
  std::vector<uint16_t> masks = link_masks(ends, links);
  if (ends.links && masks == ends.link_words) return;
  upload(context, ends.links, masks, "links");
  ends.link_words = std::move(masks);
}

inline RadioEnds make_radio_ends(gpu::Context& context, const std::vector<EndState>& transmitters,
                                 const std::vector<EndState>& receivers, const std::vector<Link>& links,
                                 const std::vector<uint32_t>& listeners = {}) {
  RadioEnds ends;
  set_places(context, ends, transmitters, receivers, listeners);
  set_links(context, ends, receivers, links);
  return ends;
}

}  // namespace wavetracer
