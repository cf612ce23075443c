// SPDX-License-Identifier: Apache-2.0
// The paths of a frame and the world that they are in, in the form that wavetracer/device/path_field.h reads.
#pragma once
#include <span>
#include <vector>

#include "radio/field_tables.hpp"
#include "radio/fields.hpp"
#include "wavetracer/device/path_rows.h"
#include "wavetracer/device/path_world.h"
#include "wavetracer/device/records.h"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct FieldFrame {
  // The geometry as solved paths, with a row for each path as it is.
  std::vector<wt_solved> solved;
  std::vector<double> vertices, transmitter_positions, receiver_positions;
  std::vector<uint32_t> steps;
  uint32_t max_depth = 1;
  bool has_quarters = false;  // does the geometry say which quarters found its paths?
  // Surfaces, wedges, instances and ends at their places in the frame.
  std::vector<wt_exact_surface> surfaces;
  std::vector<wt_wedge> wedges;
  std::vector<wt_exact_instance> instances;
  std::vector<wt_target_point> targets;
  std::vector<device::wt_field_end> transmitters, receivers;
  std::vector<double> inside;  // the metres of each path inside of each kind of vegetation
  // The rows that stay, in their order, and their delays.
  std::vector<uint32_t> rows;
  std::vector<double> delays;

  // Both point to what is here and in the tables.
  device::wt_path_list list() const;
  device::wt_field_world world(const FieldTables& tables) const;
};

// Arguments are those of FieldModel; it throws what FieldModel::compute does.
FieldFrame make_field_frame(const FieldTables& tables, const Scene& scene, std::span<const Scene> models,
                            std::span<const Instance> instances, const PathGeometry& geometry, const WorldState& state,
                            LeftOut* left_out = nullptr);

// The fields of all rows. number: that of the frame.
Paths paths_of(const FieldFrame& frame, const FieldTables& tables, const glm::dvec3& origin_m, uint32_t number);

}  // namespace wavetracer
