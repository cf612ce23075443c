// SPDX-License-Identifier: Apache-2.0
// A wave loses least straight through a slab. Materials that no surface uses are not asked for.
#include "radio/opacity.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "radio/constants.hpp"
#include "radio/material.hpp"
#include "radio/slab.hpp"

namespace wavetracer {

bool is_opaque(const Material& material, double frequency_hz) {
  if (!material.layers.empty())
    return std::ranges::any_of(material.layers, [&](const Material& layer) { return is_opaque(layer, frequency_hz); });
  const SlabCoefficients slab = slab_coefficients(complex_permittivity(material, frequency_hz), 1, material.thickness_m,
                                                  speed_of_light_m_s / frequency_hz);
  return std::abs(slab.transmission_te) < least_transmission;
}

std::vector<bool> opaque_surfaces(const Scene& scene, std::span<const Scene> models,
                                  std::span<const Instance> instances, double frequency_hz) {
  std::vector<bool> out;
  const auto append = [&](const Scene& part, size_t first) {
    if (out.size() < first + part.surfaces.size()) out.resize(first + part.surfaces.size());
    std::vector<std::optional<bool>> opaque(part.materials.size());
    for (size_t i = 0; i < part.surfaces.size(); ++i) {
      std::optional<bool>& known = opaque[part.surfaces[i].material];
      if (!known) known = is_opaque(part.materials[part.surfaces[i].material], frequency_hz);
      out[first + i] = *known;
    }
  };
  append(scene, 0);
  for (const Instance& instance : instances) append(models[instance.model], instance.first_surface);
  return out;
}

}  // namespace wavetracer
