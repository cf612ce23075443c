// SPDX-License-Identifier: Apache-2.0
#include "radio/material_table.hpp"

#include <complex>

#include "radio/material.hpp"

namespace wavetracer {
namespace {

std::vector<device::wt_material> materials_at(const Scene& scene, double frequency_hz) {
  std::vector<bool> is_used(scene.materials.size());
  for (const Surface& surface : scene.surfaces) is_used[surface.material] = true;
  std::vector<device::wt_material> records(scene.materials.size());
  for (size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) continue;
    const Material& material = scene.materials[i];
    const std::complex<double> permittivity = complex_permittivity(material, frequency_hz);
    records[i] = {.permittivity = {permittivity.real(), permittivity.imag()},
                  .thickness_m = material.thickness_m,
                  .scattering = material.scattering,
                  .cross_polar = material.scattering_cross_polar,
                  .lobe = static_cast<uint32_t>(material.scattering_lobe),
                  .padding = 0};
  }
  return records;
}

}  // namespace

MaterialTable make_material_table(const Scene& scene, std::span<const Scene> models,
                                  std::span<const Instance> instances, double frequency_hz) {
  MaterialTable out;
  std::vector<uint32_t> first;  // start of each part's materials
  const auto add_part = [&](const Scene& part) {
    first.push_back(static_cast<uint32_t>(out.materials.size()));
    const auto records = materials_at(part, frequency_hz);
    out.materials.insert(out.materials.end(), records.begin(), records.end());
  };
  const auto add_surfaces = [&](const Scene& part, uint32_t first_material) {
    for (const Surface& surface : part.surfaces) out.materials_of.push_back(first_material + surface.material);
  };
  add_part(scene);
  for (const Scene& model : models) add_part(model);
  add_surfaces(scene, first[0]);
  for (const Instance& instance : instances) add_surfaces(models[instance.model], first[1 + instance.model]);
  return out;
}

}  // namespace wavetracer
