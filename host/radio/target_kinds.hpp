// SPDX-License-Identifier: Apache-2.0
// The targets of 3GPP TR 38.901 V19 (2025), 7.9.2: cross sections, cross-polarisation and places of their points.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "wavetracer/target_config.hpp"

namespace wavetracer {

// A row of tables 7.9.2.1-2 to -7, in degrees, dBsm and dB. Width 0: the lobe is the same for all azimuths.
struct KindLobe {
  std::string_view side;
  double azimuth_deg, azimuth_width_deg, zenith_deg, zenith_width_deg, peak_dbsm, range_db;
  // The directions of the bisector for which the row counts: zeniths from and to, azimuths from and to.
  std::array<double, 4> counts_deg;
};

struct KindLaw {
  TargetKind kind;
  std::span<const KindLobe> lobes;
  bool points;              // each lobe is a point of its own; else one point has all lobes
  std::array<double, 3> k;  // see wt_target_law
  double xpr_db;            // the mean of table 7.9.2.2-1
  glm::dvec3 size_m;        // length, width, height where nothing says another size
  double height;            // height of the one point, as a share of the target's height, where there is one point
};

// The law of a kind; kind is not custom.
const KindLaw& kind_law(TargetKind kind);

// The places of the points of a kind of this size, from the middle of the footprint; kind is not custom.
std::vector<glm::dvec3> kind_points(TargetKind kind, const glm::dvec3& size_m);

}  // namespace wavetracer
