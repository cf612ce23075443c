// Boundaries are told by directions alone: across the edge the wave leaves it as the other one does. What differs of a
// unit vector, squared, is 4 sin^2(epsilon / 2), with epsilon as in wavetracer/device/utd.h, and the detour is that
// times half of the distance parameter.
#include "radio/edge_shares.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "wavetracer/device/vector.h"

namespace wavetracer {
namespace {

constexpr size_t edge = static_cast<size_t>(InPlace::edge);

// 1 without a detour, 0 from most_detour on, and smooth in between. In wavelengths.
double share_at(double detour) {
  const double part = std::min(detour / most_detour, 1.0);
  return (1 - part * part) * (1 - part * part);
}

double square(const glm::dvec3& v) { return glm::dot(v, v); }

}  // namespace

EdgeShares edge_shares(const wt_wedge& wedge, const glm::dvec3& k_in, const glm::dvec3& k_out, double before_m,
                       double after_m, double wavelength_m) {
  const glm::dvec3 along = device::wt_vector(wedge.along), face = device::wt_vector(wedge.face),
                   normal = device::wt_vector(wedge.normal);
  const glm::dvec3 across_in = k_in - glm::dot(k_in, along) * along,
                   across_out = k_out - glm::dot(k_out, along) * along;
  const double sine2 = square(across_in);
  if (!(sine2 > 1e-18) || !(square(across_out) > 1e-18) || !(before_m > 0) || !(after_m > 0)) return {1, 0, 0, 0};
  const glm::dvec3 in = across_in / std::sqrt(sine2), out = glm::normalize(across_out);
  const double scale = 0.5 * before_m * after_m / (before_m + after_m) * sine2 / wavelength_m;
  const glm::dvec3 normals[2] = {normal, face * wedge.sine - normal * wedge.cosine};

  EdgeShares near{};  // shares by the detour, as if each wave were the only one
  EdgeShares part{};
  double largest = 0, sum = 0;
  for (size_t i = 1; i < in_places; ++i) {
    glm::dvec3 other = in;
    if (i > 1) {
      const glm::dvec3& n = normals[i - 2];
      if (glm::dot(in, n) > 0 && glm::dot(out, n) < 0) continue;  // behind the face
      other = in - 2 * glm::dot(in, n) * n;
    }
    const double detour = scale * square(out - other);
    near[i] = share_at(detour);
    part[i] = near[i] / std::max(detour, 1e-12);
    largest = std::max(largest, near[i]);
    sum += part[i] * part[i];
  }
  EdgeShares shares{};
  shares[edge] = std::sqrt((1 - largest) * (1 + largest));
  if (sum > 0)
    for (size_t i = 1; i < in_places; ++i) shares[i] = largest * part[i] / std::sqrt(sum);
  return shares;
}

}  // namespace wavetracer
