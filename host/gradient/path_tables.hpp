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

// Tables of one row of a frame after the other. They keep their memory from row to row, and references to the arguments
// of the constructor; one thread uses them.
class PathTables {
 public:
  PathTables(const FieldTables& tables, const ConstantTables& constants, const FieldFrame& frame,
             const device::wt_field_world& world);

  // All that follows is about this row from now on.
  void set_row(uint32_t row);

  // The parameters of materials that the path depends on; they are valid until the next row.
  std::span<const PathDirection> material_directions();

  // Lets the vertices move with the ends. Returns whether they say how.
  bool solve_vertices();

  // Fields with one lane for each direction, at most tangent::lanes of them. The directions are materials' parameters,
  // or all positions in their order, after solve_vertices(), or all turns. delay: with its derivatives.
  tangent::wt_path_field fields(std::span<const PathDirection> directions, double frequency_hz,
                                tangent::Tangent& delay);

  // Is the path at the end of the range of a parameter, where its columns begin to change?
  bool is_singular(const PathDirection& direction) const;
  const device::wt_path& path() const { return path_; }
  const device::wt_field_world& world() const { return plain_; }

 private:
  // The end of links that the tables have, and whether it turns there.
  struct KnownEnd {
    uint32_t number = WT_NONE;
    bool turns = false;
  };

  void list_neighbours();
  void set_end(tangent::wt_field_end& to, KnownEnd& known, const std::vector<device::wt_field_end>& ends,
               uint32_t number, bool turns, int first_lane);
  void seed_material(const PathDirection& direction, int lane, double frequency_hz);
  void take_seeds_back();
  void stay();
  void move_ends();
  void sum_inside();
  tangent::wt_field_world moved_world() const;

  const FieldTables& tables_;
  const ConstantTables& constants_;
  const FieldFrame& frame_;
  const device::wt_field_world& plain_;
  const device::wt_path_list list_;
  uint32_t row_ = 0;
  device::wt_path path_{};
  MovedVertices moved_;
  std::vector<PathDirection> directions_;
  // Tables as wt_path_list and wt_field_world of the copies name them. Ends have the number 0.
  std::vector<wt_solved> solved_;
  std::vector<uint32_t> steps_, rows_, order_;
  std::vector<double> delays_;
  uint32_t place_ = 0, max_depth_ = 0;  // place_: that of the row in rows_
  std::vector<tangent::Tangent> vertices_, inside_;
  tangent::Tangent from_[4], to_[4];
  tangent::wt_field_end transmitter_, receiver_;
  KnownEnd known_transmitter_, known_receiver_;
  std::vector<tangent::wt_material> materials_;
  std::vector<tangent::wt_foliage> foliages_;
  std::vector<PathDirection> seeded_;  // directions that materials_ and foliages_ have now
};

}  // namespace wavetracer
