// SPDX-License-Identifier: Apache-2.0
// Derivatives of the columns of paths (Simulation::gradient) by materials, and by the positions and turns of the ends.
// The sequence of surfaces, edges and tiles of each path stays the same. Near a shadow boundary the derivative of one
// path is not that of the field, of which a neighbour takes over a part; the weights of groups have no derivatives.
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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
  singular,
  // The coefficients jump: they are others where points of the path are elsewhere by the rounding of file coordinates.
  jump
};

struct GradientChoice {
  bool materials = true, positions = true, orientations = false;
  std::optional<std::vector<uint32_t>> paths = {};  // rows of the paths, in any order; none: all of them
};

// Entries first[i] to first[i + 1] - 1 belong to row i of the paths. A path has an entry for each chosen parameter that
// may change one of its columns; its derivatives by all other materials are 0. For a material these are permittivity,
// conductivity and thickness where the path meets its surfaces (both faces of an edge included), S where the
// configuration scatters or the path scatters off its leaves, and the attenuations where the path passes its leaves.
// A path that was not chosen has no entry.
struct PathGradients {
  std::vector<uint64_t> first{0};
  std::vector<PathParameter> parameter;
  std::vector<uint32_t> material;  // index in `materials`; no_material_number for positions and turns
  // Derivatives of the columns of this name by the parameter: column's unit per parameter's unit. Where there is a gap
  // they are NaN.
  std::vector<std::array<std::complex<double>, 4>> a;
  std::vector<double> delay_s, aod_theta_rad, aod_phi_rad, aoa_theta_rad, aoa_phi_rad;
  std::vector<GradientGap> gap;
  // Names of materials, each once: materials of one name are one, in the scene and in its models. Layers of a wall have
  // the permittivity and conductivity of their materials, while the thickness of layer i of a wall W belongs to the
  // name "W.layers[i]", counted from 0.
  std::vector<std::string> materials;

  size_t size() const { return parameter.size(); }
};
constexpr uint32_t no_material_number = 0xFFFFFFFFu;

}  // namespace wavetracer
