// SPDX-License-Identifier: Apache-2.0
// link_sums: sums over the paths of each link, on the device; the host then reads a record of each link and no rows.
#pragma once
#include <span>
#include <vector>

#include "gpu/gpu.hpp"
#include "kernel_calls/link_sums.hpp"
#include "passes/counters.hpp"
#include "passes/tuning.hpp"
#include "radio/path_columns.hpp"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/field_records.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// The rows of a frame on the device, at most `most` of them, in their order, and their waves (path_groups), or nullptr
// without diffraction.
struct SummedRows {
  const gpu::Buffer<device::wt_path_row>& rows;
  const gpu::Buffer<device::wt_path_wave>* waves;
  const gpu::Buffer<device::wt_path_waves>* shared;
  uint32_t most;
};

class LinkSums {
 public:
  // waves: rows have waves, as with diffraction. lanes: work-items of a link, 1 or 32; the sums are the same.
  LinkSums(gpu::Context& context, double frequency_hz, Ports ports, bool waves);
  LinkSums(gpu::Context& context, double frequency_hz, Ports ports, bool waves, uint32_t lanes);
  // links: the links that are summed, in any order. counters: has the numbers of rows and of their vertices.
  void operator()(const SummedRows& of, std::span<const Link> links, Counters& counters);
  // Returns a record for each link, which are there until the next call; waits for the device.
  std::span<const device::wt_link_sum> read();

 private:
  gpu::Context& context_;
  uint32_t lanes_;
  gpu::KernelOf<calls::link_sums::link_sums> kernel_;
  uint32_t group_;
  wt_link_sums_arguments arguments_{};
  std::vector<uint32_t> link_words_;  // the words of links_
  gpu::Buffer<uint32_t> links_;
  // With waves: keys and fields of rows, then those of the tables of links.
  gpu::Buffer<uint64_t> entries_, keys_;
  gpu::Buffer<double> fields_, sums_;
  gpu::Buffer<device::wt_link_sum> out_;
  gpu::HostMemory host_;
};

}  // namespace wavetracer
