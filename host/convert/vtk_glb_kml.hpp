// SPDX-License-Identifier: Apache-2.0
// Functions that the exports of geometry (vtk, glb, kml) share: points of paths, corners of vehicles, colours of gains.
// All positions are file coordinates in metres, z up.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>
#include "base/colours.hpp"
#include "results/saved_run.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

inline bool is_finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Tells whether the file gives the vehicle a place.
inline bool is_finite(const SavedPose& pose) {
  return is_finite(pose.position_m) && is_finite(pose.rotation[0]) && is_finite(pose.rotation[1]) &&
         is_finite(pose.rotation[2]);
}

// Returns the points from the transmitter to the receiver, or none if one of them is not finite, so that the path
// cannot be drawn.
std::vector<glm::dvec3> path_points(const SavedFrame& frame, size_t path);

// Moves a point of a model's scene to the place of the vehicle.
inline glm::dvec3 placed(const SavedPose& pose, const Scene& model, const glm::dvec3& vertex) {
  return pose.position_m + pose.rotation * (model.origin_m + vertex);
}

// Maps gains to colours: the strongest path is the brightest; 60 dB below it or weaker is the darkest.
class GainScale {
 public:
  static constexpr double range_db = 60;

  void add(const Paths& paths) {
    for (const double gain_db : paths.gain_db)
      if (std::isfinite(gain_db)) strongest_db_ = std::max(strongest_db_, gain_db);
  }
  bool empty() const { return std::isinf(strongest_db_); }
  double strongest_db() const { return strongest_db_; }
  double weakest_db() const { return strongest_db_ - range_db; }
  // Returns 0 (weakest) to 1 (strongest).
  double place(double gain_db) const {
    if (!(gain_db > weakest_db())) return 0;  // for zero power, or not a number
    return std::min((gain_db - weakest_db()) / range_db, 1.0);
  }

 private:
  double strongest_db_ = -std::numeric_limits<double>::infinity();
};

Colour gain_colour(double place);

}  // namespace wavetracer
