// SPDX-License-Identifier: Apache-2.0
// The normal is the eigenvector of the covariance with the least eigenvalue, by Jacobi's rotations: they keep small
// eigenvalues accurate, and three or four sweeps are enough for a 3 x 3 matrix.
#include "scene/plane_fit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace wavetracer {
namespace {

using glm::dmat3;
using glm::dvec3;

// Turns a symmetric matrix into a diagonal one, and `axes` with it, whose columns become its eigenvectors.
void diagonalize(dmat3& m, dmat3& axes) {
  constexpr int most_sweeps = 12;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool done = true;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (m[p][q] * m[p][q] <= 1e-36 * std::abs(m[p][p] * m[q][q])) continue;  // smaller than rounding
        done = false;
        const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (theta < 0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b;
          m[k][q] = s * a + c * b;
        }
        for (int k = 0; k < 3; ++k) {
          const double a = m[p][k], b = m[q][k];
          m[p][k] = c * a - s * b;
          m[q][k] = s * a + c * b;
        }
        m[p][q] = m[q][p] = 0;
        const dvec3 a = axes[p], b = axes[q];
        axes[p] = c * a - s * b;
        axes[q] = s * a + c * b;
      }
    }
    if (done) return;
  }
}

}  // namespace

dvec3 oriented(const dvec3& normal) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) >= std::abs(normal[axis])) axis = k;
  }
  return normal[axis] < 0 ? -normal : normal;
}

double height_over(const Plane& plane, const dvec3& p) { return glm::dot(plane.normal, p) - plane.offset_m; }

void PlaneSums::add(const dvec3& p, double weight) {
  const dvec3 d = p - reference_;
  weight_ += weight;
  first_ += weight * d;
  size_t i = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) second_[i++] += weight * d[a] * d[b];
}

void PlaneSums::join(const PlaneSums& other) {
  const dvec3 step = other.reference_ - reference_;
  size_t i = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b, ++i) {
      second_[i] +=
          other.second_[i] + step[a] * other.first_[b] + step[b] * other.first_[a] + other.weight_ * step[a] * step[b];
    }
  }
  first_ += other.first_ + other.weight_ * step;
  weight_ += other.weight_;
}

FittedPlane PlaneSums::fit() const {
  const dvec3 mean = first_ / weight_;
  dmat3 covariance(0), axes(1);
  size_t i = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) covariance[a][b] = covariance[b][a] = second_[i++] / weight_ - mean[a] * mean[b];
  }
  diagonalize(covariance, axes);
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (covariance[k][k] < covariance[least][least]) least = k;
  const dvec3 normal = oriented(glm::normalize(axes[least]));
  return {{normal, glm::dot(normal, reference_ + mean)}, std::sqrt(std::max(0.0, covariance[least][least]))};
}

}  // namespace wavetracer
