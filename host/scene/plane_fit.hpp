// SPDX-License-Identifier: Apache-2.0
// Fits least-squares planes to weighted points, from sums that can be extended and joined.
// Points must be within some kilometres of the reference point about which the sums are taken.
#pragma once
#include <array>
#include <glm/vec3.hpp>

namespace wavetracer {

// The plane dot(normal, p) = offset_m.
struct Plane {
  glm::dvec3 normal{0, 0, 1};
  double offset_m = 0;
};

// Returns the normal with its largest component positive (the last one if several are equal), so that it does not
// depend on the side that the file means.
glm::dvec3 oriented(const glm::dvec3& normal);

// Returns the signed distance of a point from a plane.
double height_over(const Plane& plane, const glm::dvec3& p);

struct FittedPlane {
  Plane plane;   // its normal is oriented()
  double rms_m;  // root mean square of the distances of the points from the plane
};

class PlaneSums {
 public:
  explicit PlaneSums(const glm::dvec3& reference = glm::dvec3(0)) : reference_(reference) {}
  void add(const glm::dvec3& p, double weight = 1);
  // Adds the sums of the other's points, about this one's reference point.
  void join(const PlaneSums& other);
  FittedPlane fit() const;

 private:
  glm::dvec3 reference_;
  double weight_ = 0;
  glm::dvec3 first_{0};             // sum of w d, with d = p - reference
  std::array<double, 6> second_{};  // sums of w d d^T: xx, xy, xz, yy, yz, zz
};

}  // namespace wavetracer
