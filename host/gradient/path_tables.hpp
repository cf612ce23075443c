// SPDX-License-Identifier: Apache-2.0
// The tables of one path that the copies of the device's headers read, with tangents where parameters are, and the
// fields of the path from them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "gradient/moved_vertices.hpp"
#include "gradient/path_gradient.hpp"
#include "radio/field_frame.hpp"
#include "tangent/path_field.h"
#include "tangent/volumes.h"

namespace wavetracer {

// Tables that all paths share. They have no derivatives; a path that has some copies the table first.
struct ConstantTables {
  std::vector<tangent::wt_material> materials;
  std::vector<tangent::wt_foliage> foliages;
  std::vector<tangent::wt_antenna> antennas;
  std::vector<tangent::wt_volume> volumes;
};
ConstantTables constant_tables(const FieldTables& tables);

// A parameter of a path; material: see ModelGradients.
struct PathDirection {
  PathParameter parameter;
  uint32_t material;
};

// Row `row` of a frame. It keeps references to its arguments; one thread uses it.
class PathTables {
 public:
  PathTables(const FieldTables& tables, const ConstantTables& constants, const FieldFrame& frame,
             const device::wt_field_world& world, uint32_t row);

  // The parameters of materials that the path depends on.
  std::vector<PathDirection> material_directions() const;

  // Fields with one lane for each direction, at most tangent::lanes of them. The directions are materials' parameters,
  // or all positions in their order, or all turns. delay: with its derivatives.
  tangent::wt_path_field fields(std::span<const PathDirection> directions, double frequency_hz,
                                tangent::Tangent& delay);

  // Is the path at the end of the range of a parameter, where its columns begin to change?
  bool is_singular(const PathDirection& direction) const;
  // Do the vertices say how they move with the ends?
  bool is_solved() const { return moved_.solved; }
  const device::wt_path& path() const { return path_; }

 private:
  void list_neighbours();
  void seed_material(const PathDirection& direction, int lane, double frequency_hz);
  void move_ends();
  void turn_ends();
  void set_positions(bool moves);

  const FieldTables& tables_;
  const FieldFrame& frame_;
  const device::wt_field_world& plain_;
  uint32_t row_;
  device::wt_path path_;
  MovedVertices moved_;
  // Tables as wt_path_list and wt_field_world of the copies name them. Ends have the number 0.
  std::vector<wt_solved> solved_;
  std::vector<uint32_t> steps_, rows_;
  std::vector<double> delays_;
  uint32_t place_ = 0, max_depth_ = 0;  // place_: that of the row in rows_
  std::vector<tangent::Tangent> vertices_, inside_;
  tangent::Tangent from_[4], to_[4];
  tangent::wt_field_end transmitter_, receiver_;
  const ConstantTables& constants_;
  std::vector<tangent::wt_material> materials_;
  std::vector<tangent::wt_foliage> foliages_;
};

}  // namespace wavetracer
