// SPDX-License-Identifier: Apache-2.0
// link_floors: the powers below which links need no paths over edges, from their strongest paths without edges, and
// what the paths that are left out have at most.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/link_floors.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/field_buffers.hpp"
#include "passes/link_limits.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tuning.hpp"
#include "radio/field_tables.hpp"

namespace wavetracer {

// The paths without edges of a frame, and what their fields need. receiver_of, transmitter_of: see Distinct;
// lengths_inside: as in FieldInputs.
struct UnbentPaths {
  const DeviceScene& scene;
  const FieldBuffers& tables;
  const RadioEnds& ends;
  const gpu::Buffer<uint32_t>&receiver_of, &transmitter_of;
  const SolvedList& visible;
  const gpu::Buffer<double>* lengths_inside;
};

class LinkFloors {
 public:
  // tables: those of the fields of paths. range_db: a path over edges may be left out if a bound of its power, with the
  // largest gains of both antennas, is so much below the power of its link's strongest path without edges. passes:
  // surfaces pass waves, so these bounds are larger.
  LinkFloors(gpu::Context& context, const FieldTables& tables, double range_db, bool passes);
  // Sets the floors of all links of the ends.
  void operator()(const UnbentPaths& paths, Counters& counters);
  // materials_of: the table of fields.
  LinkLimits limits(const gpu::Buffer<uint32_t>& materials_of) const {
    return {floors_, left_out_, reflectances_, materials_of, arguments_.receiver_count, second_, left_out_unit_};
  }
  // The most that the paths that were left out of a link have together, over the power of the link's strongest path
  // without edges. It waits for the device.
  double most_left_out();

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::link_floors::link_floors> kernel_;
  gpu::KernelOf<calls::link_floors::most_left_out> most_kernel_;
  Work work_;
  wt_link_floors_arguments arguments_{};
  double second_;
  float left_out_unit_;
  uint32_t links_ = 0;
  gpu::Buffer<double> most_powers_;
  gpu::Buffer<float> reflectances_, floors_;
  gpu::Buffer<uint32_t> left_out_, most_;
};

}  // namespace wavetracer
