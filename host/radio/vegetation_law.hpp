// SPDX-License-Identifier: Apache-2.0
// Losses of waves in vegetation (ITU-R P.833-10, section 2.1), and the volumes of a scene as fields and devices read
// them. host/scene/volumes.hpp makes them.
#pragma once
#include <vector>

#include "wavetracer/device/volumes.h"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The share of its loss per metre that vegetation keeps without leaves: 1 / 1.2 up to 1 GHz, where P.833 says that the
// loss in leaf is about 20% greater; from 9.6 to 57.6 GHz the ratio of the laws of COST 235 (Final Report, 1996) at a
// depth of 1 m; between them a power of the frequency that joins both; and beyond, the last value.
double leafless_share(double frequency_hz);

// The loss in dB per metre, and the most that a path loses.
struct VegetationLoss {
  double db_m, most_db;
};
// Values that the law does not give are filled in: g is the line of Figure 2, 0.2 dB/m at 1 GHz and in proportion to
// the frequency (30 MHz to 30 GHz), times leafless_share without leaves; A_m = A_1 f^alpha (equation 2).
VegetationLoss vegetation_loss(const VegetationLaw& law, double frequency_hz);

struct VolumeTable {
  std::vector<device::wt_volume> volumes;
  std::vector<double> triangles;   // nine doubles for each triangle of a mesh
  std::vector<uint32_t> material;  // for each kind its index in Scene::materials
  std::vector<uint32_t> earlier;   // in the form of wt_volumes

  // The volumes for functions of wavetracer/device/volumes.h; valid as long as this is not changed.
  device::wt_volumes all() const { return {volumes.data(), triangles.data(), earlier.data()}; }
};
// Throws ConfigError for more than WT_MOST_KINDS kinds.
VolumeTable volume_table(const Scene& scene);

// The losses of each kind, at a carrier.
std::vector<device::wt_foliage> foliages_at(const VolumeTable& table, const Scene& scene, double frequency_hz);

}  // namespace wavetracer
