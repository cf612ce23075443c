// SPDX-License-Identifier: Apache-2.0
// The part of the configuration about radio materials.
// A value that is not given is taken from the library or the scene file.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/choice.hpp"

namespace wavetracer {

// The measurements for the largest attenuation of vegetation, see VegetationLaw (wavetracer/scene.hpp).
using Woodland = Choice<"none", "mixed", "deciduous">;
constexpr bool is_vegetation(Woodland woodland) { return woodland != "none"; }

// A layer of a wall.
struct LayerConfig {
  std::string material;    // a [[material]] without layers, or a material of the library
  double thickness_m = 0;  // above 0; infinity allowed: a half space
  bool operator==(const LayerConfig&) const = default;
};
inline constexpr size_t most_layers = 8;

struct MaterialConfig {  // [[material]]: overrides or adds a radio material by name
  std::string name;
  std::string library = {};  // the library material that it is based on; empty: that of its own name
  std::optional<double> a = {}, b = {}, c = {}, d = {};  // ITU-R P.2040 coefficients
  std::optional<double> permittivity = {}, conductivity_s_m = {};
  std::optional<double> thickness_m = {};  // infinity allowed: a half space
  std::vector<LayerConfig> layers = {};    // from the outer side inwards, at most most_layers; instead of all above
  std::optional<double> scattering = {}, scattering_lobe = {}, scattering_cross_polar = {};  // see Material
  // Leaves and twigs instead of a surface, see VegetationLaw.
  Woodland vegetation = "none";
  bool in_leaf = true;
  std::optional<double> attenuation_db_m = {}, max_attenuation_db = {};
};

}  // namespace wavetracer
