// How far from the middle of the scene anything gets in a drive, and how far it may.
// Assumes recentred coordinates; messages give those of the files.
#pragma once
#include <string>

#include "motion/trajectories.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

// As far as a scene may extend. Rays are traced in float32, which tells places at this distance apart by 6 cm, and what
// is far away widens the boxes of the trees, and so slows down the rays of all.
constexpr double farthest_m = 1e6;

class Reach {
 public:
  explicit Reach(const glm::dvec3& origin_m) : origin_m_(origin_m) {}

  // who: an end as messages name it, `transmitter "rsu"`. Throws ConfigError beyond farthest_m, and for NaN.
  void add_end(const std::string& who, const glm::dvec3& position_m);
  // A vehicle with all that is on it, which is radius_m from it at most. Throws InputError, or ConfigError for the
  // radius.
  void add_track(const Track& track, double radius_m);
  void add_box(const glm::dvec3& lower_m, const glm::dvec3& upper_m, double radius_m);

  // No coordinate is larger.
  double metres() const { return reach_m_; }

 private:
  std::string too_far(const std::string& who, const glm::dvec3& position_m, double distance_m) const;

  glm::dvec3 origin_m_;
  double reach_m_ = 0;
};

}  // namespace wavetracer
