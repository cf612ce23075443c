// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/candidates.cl.
// A work-item takes one sequence (CPUs), or a work-group several together with a part of the receivers.
#include "passes/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

namespace {

// Local memory for the sequences of a work-group, and of one sequence: its images, its surfaces, the sides of its beam
// and 160 bytes more.
constexpr uint32_t group_bytes = 16 << 10;
constexpr uint32_t beam_mirrors = 8;  // the most mirrors whose sides a beam has, see kernels/lib/beam.clh
uint32_t sequence_bytes(uint32_t reflections) {
  return 32 * (reflections + 1) + (4 * reflections + 31) / 32 * 32 + 64 * std::min(reflections, beam_mirrors) + 160;
}

// A word holds the place of a receiver and the number of a sequence in its work-group (kernels/paths/candidates.cl).
constexpr uint32_t place_bits = 25, most_places = 1u << place_bits;

// GPUs: a part has this many groups of receivers, and so many work-groups keep a compute unit busy.
constexpr uint32_t groups_of_part = 64, busy_groups = 16;

struct Division {
  uint32_t nodes_together, parts;
};

// most_nodes: the most sequences of a work-group.
Division division_of(const gpu::DeviceInfo& device, uint32_t node_count, uint32_t groups, uint32_t most_nodes) {
  const uint32_t parts = (groups + groups_of_part - 1) / groups_of_part;
  const uint64_t tasks = uint64_t{node_count} * parts, busy = uint64_t{busy_groups} * device.compute_units;
  return {static_cast<uint32_t>(std::clamp<uint64_t>(tasks / std::max<uint64_t>(busy, 1), 1, most_nodes)), parts};
}

}  // namespace

Candidates::Candidates(gpu::Context& context, uint32_t max_reflections)
    : context_(context),
      max_reflections_(max_reflections),
      work_(tuning_of(context.info()).candidates),
      list_(context.buffer<wt_candidate>(1 << 16, {"candidates", advice::links})) {
  const uint32_t reflections = std::max(std::min(max_reflections, WT_MAX_DEPTH), 1u);
  // There are at most as many sequences as work-items: each work-item follows one back.
  if (!tuning_of(context.info()).alone)
    work_.per_item = std::min(group_bytes / sequence_bytes(reflections), work_.group);
  const gpu::Definitions definitions = {{"WT_REFLECTIONS", std::to_string(reflections)},
                                        {"WT_GROUP", std::to_string(work_.group) + "u"},
                                        {"WT_NODES", work_.option()},
                                        {"WT_PLACE_BITS", std::to_string(place_bits) + "u"}};
  kernel_ = {context, definitions};
}

uint32_t Candidates::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                                const gpu::Buffer<uint32_t>& nodes, uint32_t node_count, Counters& counters) {
  const ReceiverGroups& groups = ends.groups;
  if (groups.capacity == 0) return 0;
  const bool alone = tuning_of(context_.info()).alone;
  if (!alone && groups.capacity > most_places)
    throw gpu::BufferError(
        fmt::format("a frame has {} receivers, and a GPU takes at most {}: divide the grid among several runs",
                    ends.receiver_count, most_places));
  const Division division = division_of(context_.info(), node_count, groups.capacity / groups.size, work_.per_item);
  const size_t blocks = (size_t{node_count} + division.nodes_together - 1) / division.nodes_together;
  const gpu::Range range =
      alone ? work_.range(node_count) : gpu::Range{blocks * division.parts * work_.group, work_.group};
  return fill_list(
      counters, &wt_counters::candidates, Stage::candidates, [&] { return list_.size(); },
      [&] {
        const wt_candidates_arguments arguments{.node_count = node_count,
                                                .receiver_capacity = groups.capacity,
                                                .transmitter_count = ends.transmitter_count,
                                                .max_reflections = max_reflections_,
                                                .capacity = static_cast<uint32_t>(list_.size()),
                                                .nodes_together = division.nodes_together,
                                                .parts = division.parts};
        kernel_(range, Stage::candidates,
                calls::candidates::candidates{.table = trie,
                                              .nodes = nodes,
                                              .transmitters = ends.transmitters,
                                              .exact_receivers = ends.receivers,
                                              .exact = scene.exact_surfaces,
                                              .surfaces = scene.surfaces,
                                              .order = groups.order,
                                              .places = groups.places,
                                              .boxes = groups.boxes,
                                              .areas = groups.areas,
                                              .links = groups.links,
                                              .out = list_,
                                              .counters = counters.buffer(),
                                              .args = arguments});
      },
      [&](size_t entries) {
        list_ = context_.buffer<wt_candidate>(entries, {"candidates", advice::links});
      });
}

}  // namespace wavetracer
