// Least squares planes of weighted points, from sums that can be added up and joined.
// Assumes points within some kilometres of the reference point that the sums are taken about.
#pragma once
#include <array>
#include <glm/vec3.hpp>

namespace wavetracer {

// The plane dot(normal, p) = offset_m.
struct Plane {
  glm::dvec3 normal{0, 0, 1};
  double offset_m = 0;
};

// The normal with its largest component positive (the last one of equals): the same whichever side the file means.
glm::dvec3 oriented(const glm::dvec3& normal);

// Signed distance of a point from a plane.
double height_over(const Plane& plane, const glm::dvec3& p);

struct FittedPlane {
  Plane plane;   // oriented
  double rms_m;  // of the distances of the points from it
};

class PlaneSums {
 public:
  explicit PlaneSums(const glm::dvec3& reference = glm::dvec3(0)) : reference_(reference) {}
  void add(const glm::dvec3& p, double weight = 1);
  // Sums about this one's reference point of the points of both.
  void join(const PlaneSums& other);
  FittedPlane fit() const;

 private:
  glm::dvec3 reference_;
  double weight_ = 0;
  glm::dvec3 first_{0};             // sum of w d, with d = p - reference
  std::array<double, 6> second_{};  // sums of w d d^T: xx, xy, xz, yy, yz, zz
};

}  // namespace wavetracer
