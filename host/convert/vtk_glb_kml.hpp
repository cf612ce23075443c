// What the exports of geometry (vtk, glb, kml) share: points of paths, corners of vehicles, colours of gains.
// All positions are file coordinates in metres, z up.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>
#include "results/saved_run.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

inline bool is_finite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Of a vehicle that the file places somewhere.
inline bool is_finite(const SavedPose& pose) {
  return is_finite(pose.position_m) && is_finite(pose.rotation[0]) && is_finite(pose.rotation[1]) &&
         is_finite(pose.rotation[2]);
}

// From the transmitter to the receiver; empty where one of the points is not finite, so that none can be drawn.
std::vector<glm::dvec3> path_points(const SavedFrame& frame, size_t path);

// A point of a model's scene, where the vehicle is.
inline glm::dvec3 placed(const SavedPose& pose, const Scene& model, const glm::dvec3& vertex) {
  return pose.position_m + pose.rotation * (model.origin_m + vertex);
}

using Rgb = std::array<uint8_t, 3>;  // sRGB

// Gains as colours: the strongest path is the brightest, what is 60 dB below it or weaker the darkest.
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
  // 0 (weakest) to 1 (strongest).
  double place(double gain_db) const {
    if (!(gain_db > weakest_db())) return 0;  // of no power, or not a number
    return std::min((gain_db - weakest_db()) / range_db, 1.0);
  }

 private:
  double strongest_db_ = -std::numeric_limits<double>::infinity();
};

Rgb gain_colour(double place);

}  // namespace wavetracer
