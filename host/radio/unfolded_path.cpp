// SPDX-License-Identifier: Apache-2.0
// Lengths come from unfolding: about an edge, both sides of a path turn into one plane without a change of length
// (Fermat).
#include "radio/unfolded_path.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "radio/wide_loops.hpp"

namespace wavetracer {
namespace {

constexpr double shortest_m = 1e-9;  // so that elements in one place have a finite amplitude

double distance(const glm::dvec3& p, const glm::dvec3& q) { return std::max(glm::length(p - q), shortest_m); }

// The length over points of two edges at s and t along them, with its first and second derivatives.
struct TwoEdges {
  double length, product, s, t, ss, st, tt;

  TwoEdges(const std::array<Bend, 2>& edges, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec2& at) {
    const glm::dvec3 p = edges[0].point + at.x * edges[0].along, q = edges[1].point + at.y * edges[1].along;
    const double a = distance(from, p), b = distance(p, q), c = distance(q, to);
    const glm::dvec3 u = (p - from) / a, v = (q - p) / b, w = (to - q) / c;
    const double us = glm::dot(u, edges[0].along), vs = glm::dot(v, edges[0].along), vt = glm::dot(v, edges[1].along),
                 wt = glm::dot(w, edges[1].along);
    length = a + b + c;
    product = a * b * c;
    s = us - vs;
    t = vt - wt;
    ss = (1 - us * us) / a + (1 - vs * vs) / b;
    tt = (1 - vt * vt) / b + (1 - wt * wt) / c;
    st = (vs * vt - glm::dot(edges[0].along, edges[1].along)) / b;
  }
  double determinant() const { return ss * tt - st * st; }
};

// The length is convex in both places, and the solved path is near, so a few steps suffice.
PathSpread over_edges(const std::array<Bend, 2>& edges, const glm::dvec3& from, const glm::dvec3& to) {
  constexpr int most_steps = 30;
  glm::dvec2 at(0);
  TwoEdges now(edges, from, to, at);
  for (int step = 0; step < most_steps; ++step) {
    const double determinant = now.determinant();
    if (!(determinant > 0)) break;
    glm::dvec2 move(-(now.tt * now.s - now.st * now.t) / determinant, -(now.ss * now.t - now.st * now.s) / determinant);
    // This is the gain of a step by the quadratic form; rounding leaves half of it.
    if (-(now.s * move.x + now.t * move.y) < 1e-13 * now.length * 1e-3) break;
    TwoEdges next(edges, from, to, at + move);
    for (int half = 0; half < most_steps && next.length > now.length; ++half) {
      move *= 0.5;
      next = TwoEdges(edges, from, to, at + move);
    }
    if (!(next.length < now.length)) break;
    at += move;
    now = next;
  }
  return {now.length, 1 / (now.product * std::sqrt(std::max(now.determinant(), 1e-300)))};
}

}  // namespace

Isometry mirrored(const Isometry& image, const glm::dvec3& normal, const glm::dvec3& point) {
  const glm::dmat3 mirror = glm::dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal);
  return {mirror * image.turn, mirror * image.shift + 2 * glm::dot(normal, point) * normal};
}

glm::dvec3 UnfoldedPath::coordinates(const glm::dvec3& image) const {
  if (count != 1) return image;
  const Bend& bend = bends[0];
  if (!bend.edge()) return {distance(image, bend.point), 0, 0};
  const double along = glm::dot(image - bend.point, bend.along);
  return {along, distance(image, bend.point + along * bend.along), 0};
}

// The spreading over an edge is 1 / (before after sin b sqrt(1 / before + 1 / after)) of wt_edge_spreading, with
// distances from its line.
WAVETRACER_WIDE void UnfoldedPath::between(const PointColumns& from, size_t first, size_t points, const glm::dvec3& to,
                                           double* length_m, double* amplitude) const {
  const double *const x = from.x.data() + first, *const y = from.y.data() + first, *const z = from.z.data() + first;
  if (count == 0) {
    for (size_t i = 0; i < points; ++i) {
      const double dx = x[i] - to.x, dy = y[i] - to.y, dz = z[i] - to.z;
      length_m[i] = std::max(std::sqrt(dx * dx + dy * dy + dz * dz), shortest_m);
      amplitude[i] = 1 / length_m[i];
    }
  } else if (count == 1 && !bends[0].edge()) {
    for (size_t i = 0; i < points; ++i) {
      length_m[i] = x[i] + to.x;
      amplitude[i] = 1 / (x[i] * to.x);
    }
  } else if (count == 1) {
    for (size_t i = 0; i < points; ++i) {
      const double along = x[i] - to.x, away = y[i] + to.y;
      length_m[i] = std::sqrt(away * away + along * along);
      amplitude[i] = 1 / std::sqrt(y[i] * to.y * length_m[i]);
    }
  } else {
    for (size_t i = 0; i < points; ++i) {
      const PathSpread spread = over_edges(bends, {x[i], y[i], z[i]}, to);
      length_m[i] = spread.length_m;
      amplitude[i] = spread.amplitude;
    }
  }
}

PathSpread UnfoldedPath::between(const glm::dvec3& sent_image, const glm::dvec3& heard_image) const {
  PointColumns one;
  one.add(coordinates(sent_image));
  PathSpread out{};
  between(one, 0, 1, coordinates(heard_image), &out.length_m, &out.amplitude);
  return out;
}

}  // namespace wavetracer
