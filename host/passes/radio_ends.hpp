// SPDX-License-Identifier: Apache-2.0
// Transmitters and receivers on the device: double4 records (position, instance), and receivers as float planes for the
// conservative rejection. Where paths are sought from both ends, receivers that do not send launch rays, too: they are
// called listeners. Positions are recentred metres; the instance is that of the vehicle that carries the end, -1
// without one.
#pragma once
#include <algorithm>
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/listeners.hpp"
#include "passes/receiver_groups.hpp"
#include "passes/upload.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct RadioEnds {
  gpu::Buffer<double> transmitters, receivers;  // four doubles each; the receivers of listeners follow the transmitters
  // Roots of sequences are the transmitters, then the listeners. The ends of root r are those from first_ends[r] to
  // first_ends[r + 1] - 1 of the buffer `transmitters`; receiver_of_end says which receiver an end is, if any.
  gpu::Buffer<uint32_t> first_ends, receiver_of_end;
  gpu::Buffer<float> receiver_planes;  // three planes of receiver_capacity
  gpu::Buffer<uint16_t> links;         // bit b of word tx * (receiver_capacity / 16) + g: receiver 16 g + b
  std::vector<uint16_t> link_words;    // the words of `links`
  ReceiverGroups groups;
  uint32_t transmitter_count = 0, receiver_count = 0, receiver_capacity = 0;
  bool moved = true;                                      // since the frame before, or turned, or changed their speed
  uint32_t most_ends = 1;                                 // the most that a root has
  std::vector<double> transmitter_words, receiver_words;  // the words of the buffers
  std::vector<uint32_t> first_end_words, receiver_of_end_words;
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

// Writes which ends the roots of sequences stand for. receiver_of_transmitter: no_end where a transmitter does not
// receive; empty if none does.
inline void set_roots(gpu::Context& context, RadioEnds& ends, const Listeners& listeners,
                      std::vector<uint32_t> receiver_of_transmitter) {
  const uint32_t count = ends.transmitter_count;
  receiver_of_transmitter.resize(count, no_end);
  std::vector<uint32_t> first_ends, receiver_of_end = std::move(receiver_of_transmitter);
  ends.most_ends = 1;
  for (uint32_t root = 0; root < count; ++root) first_ends.push_back(root);
  for (uint32_t i = 0; i <= listeners.count(); ++i) {
    first_ends.push_back(count + listeners.first[i]);
    if (i > 0) ends.most_ends = std::max(ends.most_ends, listeners.first[i] - listeners.first[i - 1]);
  }
  receiver_of_end.insert(receiver_of_end.end(), listeners.receivers.begin(), listeners.receivers.end());
  upload_changed(context, ends.first_ends, ends.first_end_words, std::move(first_ends), "ends of roots");
  upload_changed(context, ends.receiver_of_end, ends.receiver_of_end_words, std::move(receiver_of_end),
                 "receivers of ends");
}

// Writes the places of a frame's ends to the buffers of the frame before, where they are large enough.
inline void set_places(gpu::Context& context, RadioEnds& ends, const std::vector<EndState>& transmitters,
                       const std::vector<EndState>& receivers, const Listeners& listeners,
                       const std::vector<uint32_t>& receiver_of_transmitter = {}) {
  ends.transmitter_count = static_cast<uint32_t>(transmitters.size());
  ends.receiver_count = static_cast<uint32_t>(receivers.size());
  ends.receiver_capacity = (ends.receiver_count + 15) / 16 * 16;
  std::vector<float> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (uint32_t i = 0; i < ends.receiver_capacity; ++i)
      planes.push_back(static_cast<float>(receivers[std::min(i, ends.receiver_count - 1)].position_m[axis]));
  std::vector<EndState> launching = transmitters;
  for (const uint32_t receiver : listeners.receivers) launching.push_back(receivers[receiver]);
  upload_changed(context, ends.transmitters, ends.transmitter_words, end_quadruples(launching), "transmitters");
  set_roots(context, ends, listeners, receiver_of_transmitter);
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
                                 const Listeners& listeners = {},
                                 const std::vector<uint32_t>& receiver_of_transmitter = {}) {
  RadioEnds ends;
  set_places(context, ends, transmitters, receivers, listeners, receiver_of_transmitter);
  set_links(context, ends, receivers, links);
  return ends;
}

}  // namespace wavetracer
