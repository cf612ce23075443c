// SPDX-License-Identifier: Apache-2.0
// distinct: the rows of a frame's paths, made of the visible ones: with reversed twins, each path once, in the order of
// links, delays and surfaces. It has three kernels; the keys are sorted between the first two.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "gpu/gpu.hpp"
#include "kernel_calls/distinct.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/field_records.h"

namespace wavetracer {

// Rows at their places, see kernels/paths/distinct.cl. Buffers may be longer than `places`, the number of places.
struct RowList {
  uint32_t places = 0;
  gpu::Buffer<uint32_t> rows;
  gpu::Buffer<uint32_t> counts;  // rows at each place, then their vertices; after the scan, how many come before it
  gpu::Buffer<double> delays;
  gpu::Buffer<uint8_t> quarters;
};

class Distinct {
 public:
  // receiver_of: for each transmitter the receiver in its place, or WT_NONE; transmitter_of: the reverse. If a
  // transmitter and a receiver are one end, a path in one direction is also a path in the other.
  Distinct(gpu::Context& context, std::span<const uint32_t> receiver_of, std::span<const uint32_t> transmitter_of);

  // Computes the keys of all rows, and returns how many places they take. own: the links whose paths are wanted, in the
  // form of RadioEnds::links. Throws RuntimeError where there are too many links for a key.
  uint32_t keys(const RadioEnds& ends, const gpu::Buffer<uint16_t>& own, const SolvedList& visible, Counters& counters);
  // By sorted keys: which rows stay, and where. wt_counters has how many of what kind. wedges: null where nothing
  // diffracts.
  void place(const DeviceScene& scene, const gpu::Buffer<wt_wedge>* wedges, const RadioEnds& ends,
             const SolvedList& visible, Counters& counters);
  // The number of paths of each link that were left out.
  std::map<Link, uint32_t> left_out();

  gpu::Buffer<uint32_t>& sort_keys() { return keys_; }
  gpu::Buffer<uint32_t>& order() { return order_; }
  RowList& rows() { return rows_; }
  const gpu::Buffer<uint32_t>& receiver_of() const { return receiver_of_; }
  const gpu::Buffer<uint32_t>& transmitter_of() const { return transmitter_of_; }

 private:
  void reserve(size_t places);

  gpu::Context& context_;
  gpu::KernelOf<calls::distinct::row_keys> row_keys_;
  gpu::KernelOf<calls::distinct::mark_rows> mark_rows_;
  gpu::KernelOf<calls::distinct::order_rows> order_rows_;
  uint32_t local_;
  bool twins_;
  gpu::Buffer<uint32_t> receiver_of_, transmitter_of_, keys_, order_;
  gpu::Buffer<double> lengths_;
  gpu::Buffer<uint8_t> stays_, quarters_;
  wt_distinct_arguments arguments_{};
  RowList rows_;
};

}  // namespace wavetracer
