// SPDX-License-Identifier: Apache-2.0
// The materials of all scenes of a world in one list, part after part; the surfaces of the world point into it.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "wavetracer/device/field_records.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct MaterialTable {
  // At one frequency; those that no surface uses are all zeros. Layers of walls are records among them, and a wall of
  // layers has a second record for surfaces whose outer side is below.
  std::vector<device::wt_material> materials;
  std::vector<std::string> names;  // the material of each record; empty for walls of layers, whose layers have names
  std::vector<std::string> walls;  // for a wall of layers and for each of its layers the wall's name; else empty
  std::vector<uint32_t> materials_of;  // the material of each surface of the world
};

// Throws ConfigError for a material that some surface uses and that is not known at this frequency.
MaterialTable make_material_table(const Scene& scene, std::span<const Scene> models,
                                  std::span<const Instance> instances, double frequency_hz);

}  // namespace wavetracer
