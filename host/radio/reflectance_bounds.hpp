// SPDX-License-Identifier: Apache-2.0
// Bounds of the share of its power that a wave keeps at a mirror, for discovery by beams (kernels/lib/floor.clh).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "radio/material_table.hpp"
#include "wavetracer/device/beams.h"

namespace wavetracer {

// One bound for each of WT_COSINES equal ranges of the cosine of incidence, from grazing to normal.
using CosineBounds = std::array<float, WT_COSINES>;

// Bounds of |R|^2 of material `index`, of the polarisation that it reflects better, at most 1. They are the largest of
// samples that are so dense that the phase of the wave inside changes by less than 0.05 rad from one to the next, and
// 1% more. Where this takes more than 4096 samples, and for good conductors, the bounds are 1. table: its layers are in
// it, where it has any; the bounds then hold on both sides of the wall.
CosineBounds reflectance_bounds(std::span<const device::wt_material> table, size_t index, double wavelength_m);

struct ReflectanceBounds {
  std::vector<float> bounds;           // WT_COSINES for each material
  std::vector<uint32_t> materials_of;  // the material of each surface of the world
};

// Those of a world, which hold at each of the frequencies. There is at least one frequency. Throws as
// make_material_table.
ReflectanceBounds make_reflectance_bounds(const Scene& scene, std::span<const Scene> models,
                                          std::span<const Instance> instances, std::span<const double> frequencies_hz);

// Those of surfaces that reflect everything.
ReflectanceBounds lossless_mirrors(size_t surfaces);

}  // namespace wavetracer
