// SPDX-License-Identifier: Apache-2.0
#include "bodies/pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// The corner that is farthest from the point, as a vector from there.
glm::dvec3 longest(const Polygon& polygon, glm::dvec3 from) {
  glm::dvec3 most(0);
  for (const glm::dvec3 p : polygon)
    if (glm::dot(p - from, p - from) > glm::dot(most, most)) most = p - from;
  return most;
}

}  // namespace

std::vector<Polygon> pieces_of(const Polygon& polygon, const PieceTest& small_enough, double smallest_m) {
  std::vector<Polygon> done, waiting{polygon};
  while (!waiting.empty()) {
    const Polygon piece = std::move(waiting.back());
    waiting.pop_back();
    const glm::dvec3 centre = centroid(piece), reach = longest(piece, centre);
    const double radius_m = glm::length(reach);
    if (small_enough(piece, centre, radius_m)) {
      done.push_back(piece);
      continue;
    }
    if (radius_m < smallest_m)
      throw ConfigError(
          fmt::format("a facet would be cut into pieces of less than {} m: an end is too close to it for "
                      "physical optics, or the allowed errors are too small; move the end, or allow more",
                      smallest_m));
    const glm::dvec3 across = reach / radius_m;
    const Plane cut{across, glm::dot(across, centre)};
    for (const Plane& side : {cut, flipped(cut)}) {
      Polygon part = part_above(piece, side, 1e-9 * radius_m);
      if (!part.empty()) waiting.push_back(std::move(part));
    }
  }
  return done;
}

// The direction in which the wave leaves the source that arrives along this one: the mirrors turn it.
glm::dvec3 FacetWave::departure(glm::dvec3 direction) const {
  for (size_t i = beam.mirrors.size(); i-- > 0;)
    direction = device::wt_mirrored(direction, plane_of(body.facets[beam.mirrors[i]].corners).normal);
  return direction;
}

// The field of sources along the vectors of the basis, when it arrives.
device::wt_transfer FacetWave::arriving(glm::dvec3 direction, const device::wt_basis& sources) const {
  glm::dvec3 along = departure(direction);
  device::wt_transfer transfer = device::wt_transfer_from(device::wt_spherical_basis(along));
  transfer.matrix = device::wt_turned(transfer.matrix, sources, transfer.rows);
  for (const uint32_t mirror : beam.mirrors) {
    const glm::dvec3 normal = plane_of(body.facets[mirror].corners).normal;
    const glm::dvec3 next = device::wt_mirrored(along, normal);
    const SlabCoefficients r = reflection(mirror, along);
    device::wt_meet(&transfer, along, next, normal, {r.reflection_te.real(), r.reflection_te.imag()},
                    {r.reflection_tm.real(), r.reflection_tm.imag()});
    along = next;
  }
  return transfer;
}

SlabCoefficients FacetWave::reflection(uint32_t number, glm::dvec3 direction) const {
  const Facet& met = body.facets[number];
  BodyMaterial layers = body.materials[met.material];
  if (layers.empty()) return {-1, 1, 0, 0};
  const double cosine = glm::dot(plane_of(met.corners).normal, direction);
  if (cosine > 0) std::reverse(layers.begin(), layers.end());
  return wall_coefficients(layers, std::min(std::abs(cosine), 1.0), wavelength_m);
}

// The field of a piece at the receiver, without the phase of the way by the middle.
device::wt_matrix FacetWave::piece(const Polygon& polygon, const Ends& ends) const {
  const glm::dvec3 centre = centroid(polygon);
  const double first_m = glm::length(centre - beam.source), second_m = glm::length(receiver - centre);
  const glm::dvec3 in = (centre - beam.source) / first_m, out = (receiver - centre) / second_m;
  const double wave_number = 2 * WT_PI / wavelength_m;
  const auto phase = [&](glm::dvec3 p) { return -wave_number * glm::dot(in - out, p - centre); };
  device::wt_double2 integral(0);
  const double from = phase(polygon[0]);
  for (size_t i = 2; i < polygon.size(); ++i) {
    const double area = 0.5 * glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
    integral += device::wt_triangle_mean(from, phase(polygon[i - 1]), phase(polygon[i])) * area;
  }
  const Plane plane = lit.towards(beam.source, facet);
  const SlabCoefficients r = reflection(facet, in);
  device::wt_transfer transfer = arriving(in, ends.departure);
  device::wt_map(&transfer, device::wt_polarizations(in, plane.normal), ends.arrival,
                 device::wt_facet_matrix(in, out, plane.normal, {r.reflection_te.real(), r.reflection_te.imag()},
                                         {r.reflection_tm.real(), r.reflection_tm.imag()}, ends.arrival));
  const device::wt_double2 turn = device::wt_cos_sin(-wave_number * (first_m + second_m - ends.length_m));
  const device::wt_double2 amplitude = device::wt_facet_amplitude(integral, wavelength_m) / (first_m * second_m);
  return device::wt_scaled(transfer.matrix, device::wt_times(amplitude, turn));
}

// The points at which the wave to this point of the facet meets the facets.
std::vector<glm::dvec3> FacetWave::way(glm::dvec3 point) const {
  std::vector<glm::dvec3> vertices{point};
  glm::dvec3 image = beam.source;
  for (size_t i = beam.mirrors.size(); i-- > 0;) {
    const Plane plane = plane_of(body.facets[beam.mirrors[i]].corners);
    const double behind = height_over(plane, image), before = height_over(plane, vertices.front());
    vertices.insert(vertices.begin(), image + (vertices.front() - image) * (behind / (behind - before)));
    image -= plane.normal * (2 * behind);
  }
  return vertices;
}

Echo FacetWave::echo(const Polygon& part, const PhysicalOptics& options) const {
  const glm::dvec3 centre = centroid(part);
  Echo out;
  out.facets = beam.mirrors;
  out.facets.push_back(facet);
  out.vertices = way(centre);
  out.length_m = glm::length(centre - beam.source) + glm::length(receiver - centre);
  const Ends ends{device::wt_spherical_basis(departure(glm::normalize(centre - beam.source))),
                  device::wt_spherical_basis(glm::normalize(centre - receiver)), out.length_m};
  // The distance from a point changes over a piece of radius r by a linear term and at most r^2 / (2 d), with d the
  // least distance to the piece; its inverse and its direction change by r / d.
  const auto far = [&](const Polygon&, glm::dvec3 middle, double radius_m) {
    const double first_m = glm::length(middle - beam.source) - radius_m;
    const double second_m = glm::length(receiver - middle) - radius_m;
    if (!(first_m > 0 && second_m > 0)) return false;
    const double bend = 1 / first_m + 1 / second_m;
    return WT_PI / wavelength_m * radius_m * radius_m * bend <= options.phase_error_rad &&
           radius_m * bend <= options.amplitude_error;
  };
  device::wt_matrix sum = device::wt_diagonal({0, 0}, {0, 0});
  for (const Polygon& one : pieces_of(part, far, 1e-6 * lit.size_m()))
    sum = device::wt_matrix_sum(sum, 1, piece(one, ends));
  for (size_t i = 0; i < 4; ++i) out.matrix[i] = {sum.m[i].x, sum.m[i].y};
  return out;
}

}  // namespace wavetracer
