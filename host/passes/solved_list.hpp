// SPDX-License-Identifier: Apache-2.0
// Solved candidates on the device: solve produces them, occlusion marks them, and visible selects from them. The layout
// is wt_solved in wavetracer/device/records.h.
#pragma once
#include <algorithm>

#include "gpu/gpu.hpp"
#include "passes/advice.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

// The memory of a row with this many interactions.
constexpr uint64_t bytes_of_row(uint32_t max_depth) {
  return sizeof(wt_solved) + uint64_t{3 * sizeof(double) + sizeof(uint32_t)} * max_depth;
}

// The most rows of a list that takes at most this part of the device's memory, with so many bytes beside each row; at
// least the rows that the list begins with.
inline uint32_t most_rows(const gpu::DeviceInfo& device, uint32_t max_depth, uint64_t bytes_beside, uint64_t part,
                          uint32_t least) {
  const uint64_t most = std::min(device.max_buffer / (3 * sizeof(double) * std::max(max_depth, 1u)),
                                 device.global_memory / (part * (bytes_of_row(max_depth) + bytes_beside)));
  return static_cast<uint32_t>(std::clamp<uint64_t>(most, least, 1u << 30));
}

struct SolvedList {
  gpu::Buffer<wt_solved> headers;
  gpu::Buffer<double> vertices;
  gpu::Buffer<uint32_t> sequences;
  uint32_t count = 0, max_depth = 0;
  uint32_t deepest = UINT32_MAX;  // the most interactions of a path, which may be fewer than there is room for
  uint32_t open = 0;  // 1: rows end at their last vertex; wt_solved::transmitter is any end, and there is no receiver
  // The word of wt_counters that has the length, where `count` may be a bound of it (counters.hpp); WT_NONE: `count` is
  // exact.
  uint32_t counter = WT_NONE;

  // Makes room for this many rows of max_depth; old rows are lost. The headers, whose size is the room that there is,
  // come last: if there is no memory for a buffer, the list keeps the room that it had.
  void reserve(gpu::Context& context, size_t rows) {
    vertices = context.buffer<double>(3 * rows * max_depth, {"path vertices", advice::links});
    sequences = context.buffer<uint32_t>(rows * max_depth, {"path surfaces", advice::links});
    headers = context.buffer<wt_solved>(rows, {"solved paths", advice::links});
  }
  // Copies the rows of a list of the same depth to the beginning of this one, which has room for them.
  void copy_from(gpu::Context& context, const SolvedList& list) {
    const size_t rows = list.count;
    context.copy(list.headers, headers, rows * sizeof(wt_solved), Stage::visible);
    context.copy(list.vertices, vertices, 3 * rows * max_depth * sizeof(double), Stage::visible);
    context.copy(list.sequences, sequences, rows * max_depth * sizeof(uint32_t), Stage::visible);
    count = list.count;
    counter = list.counter;
  }
};

}  // namespace wavetracer
