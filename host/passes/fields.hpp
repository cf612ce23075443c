// SPDX-License-Identifier: Apache-2.0
// fields: delays, angles, coefficients and Doppler shifts of the paths of a frame, on the device, and their columns on
// the host. docs/method.md has the physics, wavetracer/device/path_field.h the code, with which the host computes the
// same bits (radio/fields.hpp).
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kernel_calls/fields.hpp"
#include "passes/distinct.hpp"
#include "passes/field_buffers.hpp"
#include "passes/tuning.hpp"
#include "radio/field_tables.hpp"
#include "radio/path_columns.hpp"
#include "wavetracer/frame_result.hpp"

namespace wavetracer {

// The geometry of a frame's rows. wedges: placed in the frame, or nullptr where nothing diffracts. targets: the
// points of targets in the frame, or nullptr without any. lengths_inside:
// those of the visible paths, nullptr where there is no vegetation. The counts of rows are scanned.
struct FieldInputs {
  const DeviceScene& scene;
  const gpu::Buffer<wt_wedge>* wedges;
  const gpu::Buffer<wt_target_point>* targets;
  const RadioEnds& ends;
  const SolvedList& visible;
  const gpu::Buffer<double>* lengths_inside;
  const Distinct& distinct;
  const RowList& rows;
};

// Some rows of a frame: a list of their places, as the kernel takes it, and their numbers in the list.
struct RowChoice {
  gpu::Buffer<uint32_t> listed, before;
  uint32_t count = 0;
};

class Fields {
 public:
  // edges: the most of a path; one, two and more edges each need a larger kernel. origin_m: that of recentred
  // coordinates. corners_apart: paths past corners have a launch of their own; the fields are the same.
  Fields(gpu::Context& context, const FieldTables& tables, uint32_t edges, const glm::dvec3& origin_m);
  Fields(gpu::Context& context, const FieldTables& tables, uint32_t edges, const glm::dvec3& origin_m,
         bool corners_apart);

  // Computes the rows. most: the most rows and vertices that there may be. for_sums: link_sums alone reads them, so
  // CPUs leave out angles, gains, and all of a vertex but its kind.
  void operator()(const FieldInputs& inputs, const WorldState& world, RowCounts most, bool for_sums = false);
  // Chooses rows by their numbers in the order of rows, which must ascend.
  RowChoice choose(const RowList& rows, std::span<const uint32_t> chosen) const;
  // Computes the chosen rows alone, in their order, after the frame of the inputs and before any other one.
  void again(const FieldInputs& inputs, const RowChoice& choice);
  // Sets the ends, whose antennas may have been turned since the frame: again() takes them as they are now.
  void set_ends(const WorldState& world);
  // The tables on the device; set_ends must have run.
  FieldBuffers buffers() const {
    return {materials_, materials_of_, antennas_, samples_, foliages_, ends_[0], ends_[1]};
  }
  void set_materials(const std::vector<device::wt_material>& materials) {
    materials_.write(materials, 0, Stage::fields);
  }
  // Begins to read the rows that were computed last, `expected` of them.
  void begin_read(uint32_t frame, RowCounts expected);
  // Many rows are read in parts of so many, whose columns can be filled while later parts are on their way.
  static constexpr uint32_t rows_of_part = 1 << 14;
  // Makes room for the columns of these rows. It calls nothing of OpenCL, so that another thread may do so meanwhile.
  void size_room();
  // Fills the columns of the parts as they arrive, if there are several, and if all rows are read. count: the number of
  // rows.
  void fill_arriving(RowCounts count);
  // Returns their columns. count: the number of rows. The device must have finished.
  Paths columns(RowCounts count);
  // Takes paths that are needed no more: the next columns use their memory.
  void give_room(Paths paths) { room_ = std::move(paths); }
  // The records of the rows that were computed last, on the device, in their order.
  const gpu::Buffer<device::wt_path_row>& rows() const { return rows_; }
  // The number of the paths that columns() or carrier() gave last that are closer to an edge than the theory of
  // diffraction holds.
  uint32_t near_edges() const { return near_edges_; }
  // The same for the columns that differ at the carrier of these tables; the caller names its frequency.
  void begin_read_carrier(RowCounts expected);
  CarrierFields carrier(RowCounts count);

 private:
  gpu::Context& context_;
  bool apart_;    // paths past corners have a launch of their own, which takes them from a list
  bool in_runs_;  // work-items take runs of rows
  gpu::KernelOf<calls::fields::fields> kernel_;
  gpu::Definitions listed_build_;
  std::optional<gpu::KernelOf<calls::fields::fields>> listed_kernel_;  // built where it is needed first
  Work work_;
  uint32_t transmitters_;
  Ports ports_;
  wt_fields_arguments arguments_{};
  gpu::Buffer<device::wt_material> materials_;
  gpu::Buffer<uint32_t> materials_of_, surface_of_tile_;
  gpu::Buffer<double> area_of_tile_, samples_;
  gpu::Buffer<uint32_t> listed_;  // the number of listed rows, then their places
  gpu::Buffer<device::wt_antenna> antennas_;
  gpu::Buffer<device::wt_foliage> foliages_;
  gpu::Buffer<device::wt_target_law> laws_;
  gpu::Buffer<device::wt_target_lobe> lobes_;
  gpu::Buffer<device::wt_target_facet> facets_;
  gpu::Buffer<device::wt_field_end> ends_[2];  // transmitters, receivers
  std::vector<device::wt_field_end> end_records_[2];
  SharedList<EndState> end_states_[2];  // those that the records were made of
  gpu::Buffer<device::wt_path_row> rows_;
  gpu::Buffer<device::wt_vertex_row> vertices_;
  gpu::HostMemory host_rows_, host_vertices_;
  struct Part {
    RowCounts end;
    gpu::Marker read;
  };
  std::vector<Part> parts_;          // the parts that are being read; none if all is read at once
  RowCounts read_;                   // rows and vertices that were read already
  std::optional<RowCounts> filled_;  // those whose columns are filled already
  uint32_t frame_ = 0, near_edges_ = 0;
  Paths room_;  // the columns of the next rows, or memory for them

  calls::fields::fields call_of(const FieldInputs& inputs) const;
  void make_host_rooms();
  FrameRows rows_of(RowCounts count) const;
};

}  // namespace wavetracer
