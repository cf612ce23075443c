// SPDX-License-Identifier: Apache-2.0
// The quadratic surface is a polynomial of the two coordinates in the plane, fitted by normal equations.
#include "scene/region_steps.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/topology.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr double most_smooth_border = 0.25;  // share of the border's length
constexpr double least_noise = 0.1;          // share of the heights that curvature does not explain
constexpr size_t few_vertices = 16;          // so few vertices may fit a plane by chance
constexpr size_t terms = 6;

// Solves least squares by Cholesky; coefficients that the vertices do not determine stay zero.
class Polynomial {
 public:
  void add(const std::array<double, terms>& row, double height_m) {
    for (size_t i = 0; i < terms; ++i) {
      right_[i] += row[i] * height_m;
      for (size_t j = 0; j <= i; ++j) left_[i][j] += row[i] * row[j];
    }
  }
  std::array<double, terms> solve() {
    for (size_t i = 0; i < terms; ++i) {
      for (size_t j = 0; j <= i; ++j) {
        double sum = left_[i][j];
        for (size_t k = 0; k < j; ++k) sum -= left_[i][k] * left_[j][k];
        if (i == j)
          left_[i][i] = sum > 1e-9 * left_[0][0] * left_[0][0] ? std::sqrt(sum) : 0;
        else
          left_[i][j] = left_[j][j] > 0 ? sum / left_[j][j] : 0;
      }
    }
    std::array<double, terms> x{};
    for (size_t i = 0; i < terms; ++i) {
      double sum = right_[i];
      for (size_t k = 0; k < i; ++k) sum -= left_[i][k] * x[k];
      x[i] = left_[i][i] > 0 ? sum / left_[i][i] : 0;
    }
    for (size_t i = terms; i-- > 0;) {
      double sum = x[i];
      for (size_t k = i + 1; k < terms; ++k) sum -= left_[k][i] * x[k];
      x[i] = left_[i][i] > 0 ? sum / left_[i][i] : 0;
    }
    return x;
  }

 private:
  std::array<std::array<double, terms>, terms> left_{};
  std::array<double, terms> right_{};
};

class CurvatureTest {
 public:
  CurvatureTest(const FlatMesh& mesh, const FlatNeighbours& neighbours, const std::vector<FlatRegion>& regions)
      : scene_(mesh.scene), neighbours_(neighbours), region_of_(mesh.region_of_triangle(regions)) {}

  bool is_curved(uint32_t r, const FlatRegion& region) const {
    return smooth_border(r, region) > most_smooth_border && noise(region) < least_noise;
  }

 private:
  double smooth_border(uint32_t r, const FlatRegion& region) const {
    double all_m = 0, smooth_m = 0;
    for (const uint32_t t : region.triangles) {
      neighbours_.visit_edges(t, [&](uint32_t edge, bool is_free) {
        if (is_free) all_m += neighbours_.length_m(edge);
      });
      neighbours_.visit(t, [&](const FlatNeighbour& pair) {
        if (region_of_[pair.other] == r || pair.edge != pair.other_edge) return;
        const double length_m = neighbours_.length_m(pair.edge);
        all_m += length_m;
        const double cosine = glm::dot(triangle_shape(scene_, pair.other).normal, region.plane.normal);
        if (std::abs(cosine) >= least_cosine && neighbours_.unfolded(pair, region.plane.normal)) smooth_m += length_m;
      });
    }
    return all_m > 0 ? smooth_m / all_m : 0;
  }

  // Returns the root mean square of the heights over the quadratic surface, divided by that of the heights over the
  // plane.
  double noise(const FlatRegion& region) const {
    if (region.vertices.size() <= few_vertices) return 0;
    const dvec3& normal = region.plane.normal;
    const dvec3 other = std::abs(normal.z) < 0.7 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    const dvec3 right = glm::normalize(glm::cross(other, normal)), up = glm::cross(normal, right);
    dvec3 centre(0);
    for (const uint32_t v : region.vertices) centre += scene_.vertices[v] / static_cast<double>(region.vertices.size());
    double radius_m = 0;
    for (const uint32_t v : region.vertices) radius_m = std::max(radius_m, glm::distance(centre, scene_.vertices[v]));
    const auto row = [&](uint32_t v) {
      const dvec3 d = (scene_.vertices[v] - centre) / radius_m;
      const double x = glm::dot(d, right), y = glm::dot(d, up);
      return std::array<double, terms>{1, x, y, x * x, x * y, y * y};
    };
    Polynomial polynomial;
    for (const uint32_t v : region.vertices) polynomial.add(row(v), height_over(region.plane, scene_.vertices[v]));
    const std::array<double, terms> x = polynomial.solve();
    double flat = 0, curved = 0;
    for (const uint32_t v : region.vertices) {
      const double height_m = height_over(region.plane, scene_.vertices[v]);
      const std::array<double, terms> at = row(v);
      double rest_m = height_m;
      for (size_t i = 0; i < terms; ++i) rest_m -= x[i] * at[i];
      flat += height_m * height_m;
      curved += rest_m * rest_m;
    }
    const double freedom =
        static_cast<double>(region.vertices.size()) / static_cast<double>(region.vertices.size() - terms);
    return flat > 0 ? std::sqrt(curved * freedom / flat) : 0;
  }

  const Scene& scene_;
  const FlatNeighbours& neighbours_;
  std::vector<uint32_t> region_of_;
};

}  // namespace

void give_back_curved(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions) {
  const CurvatureTest test(mesh, neighbours, regions);
  std::vector<FlatRegion> kept;
  for (uint32_t r = 0; r < regions.size(); ++r)
    if (regions[r].exact || !test.is_curved(r, regions[r])) kept.push_back(std::move(regions[r]));
  regions = std::move(kept);
}

}  // namespace wavetracer
