// Solved candidates on the device: what solve produces, occlusion marks and visible selects.
// Layout: wt_solved in wavetracer/device/records.h.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/advice.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

struct SolvedList {
  gpu::Buffer<wt_solved> headers;
  gpu::Buffer<double> vertices;
  gpu::Buffer<uint32_t> sequences;
  uint32_t count = 0, max_depth = 0;
  uint32_t deepest = UINT32_MAX;  // no path has more interactions than this, which may be less than there is room for
  // The word of wt_counters that has the length, where `count` may be a bound of it (counters.hpp); WT_NONE: it is
  // exact.
  uint32_t counter = WT_NONE;

  // Room for so many rows of max_depth; what was there is lost. The headers, whose size says how much room there is,
  // come last: where there is no memory for a buffer, the list goes on with the room that it had.
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
