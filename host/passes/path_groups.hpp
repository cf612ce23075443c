// SPDX-License-Identifier: Apache-2.0
// path_groups: the geometrical waves that the paths of a frame belong to, on the device, and the groups of paths that
// follow from them, on the host. wavetracer/device/path_groups.h says which waves these are.
#pragma once
#include <utility>

#include "kernel_calls/path_groups.hpp"
#include "passes/distinct.hpp"
#include "passes/tuning.hpp"
#include "radio/group_numbers.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer {

class PathGroups {
 public:
  // planes_of: for each surface of the world the surface that stands for its plane. edges: the most of a path.
  PathGroups(gpu::Context& context, const std::vector<uint32_t>& planes_of, uint32_t edges, double wavelength_m);

  // Computes the waves of all rows, whose counts are scanned. wedges: placed in the frame, or nullptr where nothing
  // diffracts. most: the most rows that there may be.
  void operator()(const gpu::Buffer<wt_wedge>* wedges, const RadioEnds& ends, const SolvedList& visible,
                  const Distinct& distinct, const RowList& rows, uint32_t most);
  // The records on the device: a wave of each row, and all waves of those that belong to several.
  const gpu::Buffer<device::wt_path_wave>& waves() const { return waves_; }
  const gpu::Buffer<device::wt_path_waves>& shared() const { return shared_; }
  // Begins to read the first `expected` rows.
  void begin_read(uint32_t expected);
  // Numbers the groups of `count` rows, which must have been read: so the device can go on with what was enqueued after
  // begin_read(). If there are more rows than expected, set() does it.
  void number(size_t count);
  // Sets the columns of groups in `paths`, which are the paths of the rows. The device must have finished.
  void set(Paths& paths);
  // Takes columns that are needed no more: the next ones use their memory.
  void give_room(GroupColumns columns) { room_ = std::move(columns); }

 private:
  void make_rows(size_t most);
  GroupColumns numbered(size_t count);

  gpu::Context& context_;
  gpu::KernelOf<calls::path_groups::path_groups> kernel_;
  Work work_;
  wt_path_groups_arguments arguments_{};
  gpu::Buffer<uint32_t> planes_of_;
  gpu::Buffer<device::wt_path_wave> waves_;
  gpu::Buffer<device::wt_path_waves> shared_;  // the waves of paths that belong to several
  gpu::Buffer<uint32_t> shared_count_;
  gpu::HostMemory host_waves_, host_shared_, host_shared_count_;
  size_t read_ = 0, shared_read_ = 0;  // rows and records that were read already
  size_t last_shared_ = 0;             // records of the last frame
  GroupColumns room_;                  // memory for the columns of the next rows
  GroupColumns numbered_;              // the columns that number() has made
};

}  // namespace wavetracer
