// The transverse field of a wave along a path, by successive bases normal to and in the plane of incidence.
// Assumes that each basis handed in is orthonormal and normal to the direction of travel.
#include "radio/transfer.hpp"

namespace wavetracer {
namespace {

// The rows of matrix, given along from[0], from[1], along to[0], to[1] instead.
Matrix2 turned(const Matrix2& m, const std::array<glm::dvec3, 2>& from, const std::array<glm::dvec3, 2>& to) {
  const double c00 = glm::dot(to[0], from[0]), c01 = glm::dot(to[0], from[1]);
  const double c10 = glm::dot(to[1], from[0]), c11 = glm::dot(to[1], from[1]);
  return {c00 * m[0] + c01 * m[2], c00 * m[1] + c01 * m[3], c10 * m[0] + c11 * m[2], c10 * m[1] + c11 * m[3]};
}

// The unit normal of the plane of incidence. At normal incidence there is no such plane, TE and TM are one and any
// direction in the surface serves: below 1e-8 the cross product has lost half its digits, and the two differ by less.
glm::dvec3 incidence_normal(const glm::dvec3& k, const glm::dvec3& normal) {
  const glm::dvec3 across = glm::cross(k, normal);
  const double sine = glm::length(across);
  if (sine > 1e-8) return across / sine;
  const glm::dvec3 least_along = std::abs(k.x) < 0.5 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
  return glm::normalize(glm::cross(k, least_along));
}

}  // namespace

Transfer::Transfer(const SphericalBasis& departure)
    : matrix_{1.0, 0.0, 0.0, 1.0}, first_(departure.theta), second_(departure.phi) {}

void Transfer::meet(const glm::dvec3& k_in, const glm::dvec3& k_out, const glm::dvec3& normal, std::complex<double> te,
                    std::complex<double> tm) {
  const glm::dvec3 s = incidence_normal(k_in, normal);
  matrix_ = turned(matrix_, {first_, second_}, {s, glm::cross(s, k_in)});
  matrix_[0] *= te;
  matrix_[1] *= te;
  matrix_[2] *= tm;
  matrix_[3] *= tm;
  first_ = s;
  second_ = glm::cross(s, k_out);
}

void Transfer::map(const std::array<glm::dvec3, 2>& from, const std::array<glm::dvec3, 2>& to, const Matrix2& matrix) {
  const Matrix2 m = turned(matrix_, {first_, second_}, from);
  matrix_ = {matrix[0] * m[0] + matrix[1] * m[2], matrix[0] * m[1] + matrix[1] * m[3],
             matrix[2] * m[0] + matrix[3] * m[2], matrix[2] * m[1] + matrix[3] * m[3]};
  first_ = to[0];
  second_ = to[1];
}

Matrix2 Transfer::seen_in(const SphericalBasis& arrival) const {
  return turned(matrix_, {first_, second_}, {arrival.theta, arrival.phi});
}

}  // namespace wavetracer
