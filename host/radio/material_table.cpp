// SPDX-License-Identifier: Apache-2.0
#include "radio/material_table.hpp"

#include <complex>

#include "radio/material.hpp"

namespace wavetracer {
namespace {

static_assert(WT_MOST_LAYERS == most_layers && WT_MOST_LAYERS <= WT_LAYER_COUNT);

device::wt_material record_of(const Material& material, double frequency_hz) {
  const Material& met = material.layers.empty() ? material : material.layers.front();
  const std::complex<double> permittivity = complex_permittivity(met, frequency_hz);
  return {.permittivity = {permittivity.real(), permittivity.imag()},
          .thickness_m = material.thickness_m,
          .scattering = material.scattering,
          .cross_polar = material.scattering_cross_polar,
          .lobe = static_cast<uint32_t>(material.scattering_lobe),
          .layers = 0};
}

// Adds the materials of a part to the table: a record for each, then for walls of layers their layers and a second
// record, for surfaces whose outer side is below. Returns the record of each material for such a surface.
std::vector<uint32_t> add_materials(MaterialTable& all, const Scene& scene, double frequency_hz) {
  std::vector<device::wt_material>& table = all.materials;
  std::vector<bool> is_used(scene.materials.size());
  for (const Surface& surface : scene.surfaces) is_used[surface.material] = true;
  const auto first = static_cast<uint32_t>(table.size());
  table.resize(first + scene.materials.size());
  for (const Material& material : scene.materials) {
    all.names.push_back(material.layers.empty() ? material.name : "");
    all.walls.push_back(material.layers.empty() ? "" : material.name);
  }
  std::vector<uint32_t> below;
  for (uint32_t i = 0; i < scene.materials.size(); ++i) {
    below.push_back(first + i);
    if (!is_used[i]) continue;
    const Material& material = scene.materials[i];
    device::wt_material record = record_of(material, frequency_hz);
    if (!material.layers.empty()) {
      record.layers = static_cast<uint32_t>(table.size() << WT_LAYER_SHIFT | material.layers.size());
      for (const Material& layer : material.layers) {
        table.push_back(record_of(layer, frequency_hz));
        all.names.push_back(layer.name);
        all.walls.push_back(material.name);
      }
      below.back() = static_cast<uint32_t>(table.size());
      all.names.push_back("");
      all.walls.push_back(material.name);
      table.push_back(record);
      table.back().layers |= WT_LAYERS_REVERSED;
    }
    table[first + i] = record;
  }
  return below;
}

}  // namespace

MaterialTable make_material_table(const Scene& scene, std::span<const Scene> models,
                                  std::span<const Instance> instances, double frequency_hz) {
  MaterialTable out;
  std::vector<uint32_t> first;               // start of each part's materials
  std::vector<std::vector<uint32_t>> below;  // for each part, see add_materials
  const auto add_part = [&](const Scene& part) {
    first.push_back(static_cast<uint32_t>(out.materials.size()));
    below.push_back(add_materials(out, part, frequency_hz));
  };
  const auto add_surfaces = [&](const Scene& part, uint32_t number) {
    for (const Surface& surface : part.surfaces)
      out.materials_of.push_back(surface.outer_is_below ? below[number][surface.material]
                                                        : first[number] + surface.material);
  };
  add_part(scene);
  for (const Scene& model : models) add_part(model);
  add_surfaces(scene, 0);
  for (const Instance& instance : instances) add_surfaces(models[instance.model], 1 + instance.model);
  return out;
}

}  // namespace wavetracer
