// SPDX-License-Identifier: Apache-2.0
// Derivatives of the columns of paths for fixed sequences of surfaces, edges and tiles. They are exact: the code of
// fields is compiled once more with numbers that carry their derivatives (docs/design/gradients.md).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "radio/field_tables.hpp"
#include "radio/fields.hpp"
#include "wavetracer/gradient.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class PathTables;

// The result of GradientModel: derivatives of rows of `paths`. material: the record in MaterialTable
// (radio/material_table.hpp): the materials of the scene, then the layers of its walls, then those of each model in
// turn. A wall of layers has the S of its own record, and the rest of those of its layers. `materials` is empty.
struct ModelGradients : PathGradients {
  Paths paths;                 // those of FieldModel, bit for bit
  std::vector<uint32_t> path;  // the row in the geometry of each row of `paths`
};

// At a kink the derivative is that of one side: at lines of a pattern file's grid, where the pattern of TR 38.901
// reaches its least value, and where an effect begins or ends. Which paths there are, what hides them, and on which
// side of a shadow boundary an end lies does not change: near a boundary the derivative of one path is not that of the
// field, of which a neighbour takes over a part.
class GradientModel {
 public:
  // It takes the arguments of FieldModel, and keeps references to the scene and the models.
  GradientModel(const Scene& scene, const Config& config, std::span<const Scene> models = {},
                std::span<const Instance> instances = {});

  // It takes the arguments of FieldModel::compute, and throws what that does. choice.paths: rows of the geometry.
  ModelGradients compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                         const GradientChoice& choice = {}) const;

  const FieldTables& tables() const { return tables_; }

 private:
  // Writes the entries of a row, which have their room.
  void write_row(ModelGradients& out, PathTables& path, uint32_t row, const GradientChoice& choice) const;

  const Scene& scene_;
  std::span<const Scene> models_;
  std::vector<Instance> instances_;
  FieldTables tables_;
  double frequency_hz_;
};

}  // namespace wavetracer
