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

using PerBend = std::array<double, most_bends>;

// The length over points of edges at places `at` along them, with its first and second derivatives by these places:
// each place is in two neighbouring terms, so the matrix has a diagonal and its neighbours. A point that scatters has
// no place along it, and the wave starts there anew: a 1 on the diagonal.
struct OverBends {
  double length = 0, product = 1, determinant = 1;
  PerBend slope{}, diagonal{}, beside{};

  OverBends(const UnfoldedPath& path, const glm::dvec3& from, const glm::dvec3& to, const PerBend& at) {
    const auto count = static_cast<size_t>(path.count);
    glm::dvec3 last = from;
    for (size_t k = 0; k <= count; ++k) {
      const Bend* bend = k < count ? &path.bends[k] : nullptr;
      const glm::dvec3 next = bend ? bend->point + at[k] * bend->along : to;
      const double part = distance(last, next);
      const glm::dvec3 way = (next - last) / part;
      length += part;
      product *= part;
      if (bend) add(k, glm::dot(way, bend->along), 1, part);
      if (k > 0) add(k - 1, glm::dot(way, path.bends[k - 1].along), -1, part);
      if (bend && k > 0) {
        const glm::dvec3& before = path.bends[k - 1].along;
        beside[k - 1] = (glm::dot(way, before) * glm::dot(way, bend->along) - glm::dot(before, bend->along)) / part;
      }
      last = next;
    }
    for (size_t k = 0; k < count; ++k)
      if (!path.bends[k].edge()) diagonal[k] = 1;
    reduce(count);
  }

  // Newton's step: the solution of the system with the slopes. `reduced` and the factors are those of its elimination.
  PerBend step(size_t count) const {
    PerBend out{};
    for (size_t k = 0; k < count; ++k) out[k] = -slope[k] - (k > 0 ? factor[k - 1] * out[k - 1] : 0.0);
    for (size_t k = count; k-- > 0;) out[k] = out[k] / reduced[k] - (k + 1 < count ? factor[k] * out[k + 1] : 0.0);
    return out;
  }

 private:
  PerBend reduced{}, factor{};

  void add(size_t k, double along, double sign, double part) {
    slope[k] += sign * along;
    diagonal[k] += (1 - along * along) / part;
  }

  void reduce(size_t count) {
    for (size_t k = 0; k < count; ++k) {
      reduced[k] = diagonal[k] - (k > 0 ? factor[k - 1] * beside[k - 1] : 0.0);
      factor[k] = beside[k] / reduced[k];
      determinant *= reduced[k];
      if (!(reduced[k] > 0)) determinant = 0;
    }
  }
};

// The length is convex in all places, and the solved path is near, so a few steps suffice.
PathSpread over_bends(const UnfoldedPath& path, const glm::dvec3& from, const glm::dvec3& to) {
  constexpr int most_steps = 30;
  const auto count = static_cast<size_t>(path.count);
  PerBend at{};
  OverBends now(path, from, to, at);
  for (int step = 0; step < most_steps && now.determinant > 0; ++step) {
    const PerBend move = now.step(count);
    double gain = 0;  // the step has this gain by the quadratic form; rounding leaves half of it
    for (size_t k = 0; k < count; ++k) gain -= now.slope[k] * move[k];
    if (gain < 1e-13 * now.length * 1e-3) break;
    const auto moved = [&](double share) {
      PerBend places = at;
      for (size_t k = 0; k < count; ++k) places[k] += share * move[k];
      return places;
    };
    double share = 1;
    OverBends next(path, from, to, moved(share));
    for (int half = 0; half < most_steps && next.length > now.length; ++half) {
      share *= 0.5;
      next = OverBends(path, from, to, moved(share));
    }
    if (!(next.length < now.length)) break;
    at = moved(share);
    now = next;
  }
  return {now.length, 1 / (now.product * std::sqrt(std::max(now.determinant, 1e-300)))};
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
      const PathSpread spread = over_bends(*this, {x[i], y[i], z[i]}, to);
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
