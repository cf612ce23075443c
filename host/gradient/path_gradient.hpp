// SPDX-License-Identifier: Apache-2.0
// Derivatives of the columns of paths for fixed sequences of surfaces, edges and tiles. They are exact: the code of
// fields is compiled once more with numbers that carry their derivatives (docs/design/gradients.md).
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "radio/field_tables.hpp"
#include "radio/fields.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// A number that paths depend on. All others stay as they are: so do the carrier, the velocities and the other
// parameters of a material, such as the lobe and cross-polarization of its scattering.
enum class PathParameter : uint8_t {
  // Parameters of a material at the carrier. S is that of its surfaces and of its leaves.
  permittivity,      // real part of the relative permittivity
  conductivity,      // S/m
  thickness,         // m
  scattering,        // S
  attenuation,       // dB/m, of vegetation
  most_attenuation,  // dB, the most that a path loses in vegetation
  // Coordinates of the ends in the axes of the scene, m. The vertices of the path move with them; scattering points do
  // not.
  tx_x,
  tx_y,
  tx_z,
  rx_x,
  rx_y,
  rx_z,
  // Small turns of the ends' antennas about the axes of the scene, rad; right-handed.
  tx_turn_x,
  tx_turn_y,
  tx_turn_z,
  rx_turn_x,
  rx_turn_y,
  rx_turn_z
};

// Says why a derivative is not there.
enum class GradientGap : uint8_t {
  none,
  // The vertices are not those of a solved path (to 10 micrometres), so nobody knows how they move.
  not_solved,
  // A leg or an antenna points exactly to a pole, where angles and the antenna's polarizations jump.
  pole,
  // The derivative is infinite or does not exist: that of sqrt(1 - S^2) at S = 1, or that by positions where a leg from
  // an end to an edge runs exactly along a face of the edge.
  singular
};

struct GradientChoice {
  bool materials = true, positions = true, orientations = false;
};

// Entries first[i] to first[i + 1] - 1 belong to row i of the paths. A path has an entry for each chosen parameter that
// may change one of its columns; its derivatives by all other materials are 0. For a material these are permittivity,
// conductivity and thickness where the path meets its surfaces (both faces of an edge included), S where the
// configuration scatters or the path scatters off its leaves, and the attenuations where the path passes its leaves.
struct PathGradients {
  Paths paths;  // those of FieldModel, bit for bit
  std::vector<uint64_t> first{0};
  std::vector<PathParameter> parameter;
  // The material: its record in MaterialTable (radio/material_table.hpp): the materials of the scene, then the layers
  // of its walls, then those of each model in turn. A wall of layers has the S of its own record, and the rest of those
  // of its layers. No material: no_material_number.
  std::vector<uint32_t> material;
  // Derivatives of the columns of this name by the parameter: column's unit per parameter's unit. Where there is a gap
  // they are NaN.
  std::vector<std::array<std::complex<double>, 4>> a;
  std::vector<double> delay_s, aod_theta_rad, aod_phi_rad, aoa_theta_rad, aoa_phi_rad;
  std::vector<GradientGap> gap;

  size_t size() const { return parameter.size(); }
};
constexpr uint32_t no_material_number = 0xFFFFFFFFu;

// At a kink the derivative is that of one side: at lines of a pattern file's grid, where the pattern of TR 38.901
// reaches its least value, and where an effect begins or ends. Which paths there are, what hides them, and on which
// side of a shadow boundary an end lies does not change: near a boundary the derivative of one path is not that of the
// field, of which a neighbour takes over a part.
class GradientModel {
 public:
  // It takes the arguments of FieldModel, and keeps references to the scene and the models.
  GradientModel(const Scene& scene, const Config& config, std::span<const Scene> models = {},
                std::span<const Instance> instances = {});

  // It takes the arguments of FieldModel::compute, and throws what that does.
  PathGradients compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                        const GradientChoice& choice = {}) const;

 private:
  const Scene& scene_;
  std::span<const Scene> models_;
  std::vector<Instance> instances_;
  FieldTables tables_;
  double frequency_hz_;
};

}  // namespace wavetracer
