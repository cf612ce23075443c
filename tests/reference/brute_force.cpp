// SPDX-License-Identifier: Apache-2.0
// Image method over all sequences (as in McKown and Hamilton, "Ray tracing as a design tool for radio networks",
// IEEE Network 5(6), 1991); wedges are met halfway, by sequences of both ends. Assumes what brute_force.hpp says.
#include "reference/brute_force.hpp"
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>
#include "reference/planes.hpp"
#include "reference/wedge_points.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer::reference {
namespace {

using glm::dvec3;

using Points = std::vector<dvec3>;

// Relative to coordinates: reflections so near to each other happen in one point.
constexpr double corner_tolerance = 1e-9;

// Reflections in a row, as one end sees them. image[k]: the end mirrored by the first k surfaces.
struct Chain {
  std::vector<uint32_t> surfaces;
  Points image;
};

struct Vertex {
  uint8_t kind;  // Interaction
  uint32_t number;
  dvec3 point;
};
using Path = std::vector<Vertex>;  // ends excluded

// All chains of an end up to a length, the shorter ones first.
std::vector<Chain> chains(const Scene& scene, const dvec3& end, size_t max_length) {
  std::vector<Chain> result{{{}, {end}}};
  for (size_t i = 0; i < result.size() && result[i].surfaces.size() < max_length; ++i)
    for (uint32_t surface = 0; surface < scene.surfaces.size(); ++surface) {
      if (!result[i].surfaces.empty() && result[i].surfaces.back() == surface) continue;
      Chain longer = result[i];
      longer.surfaces.push_back(surface);
      longer.image.push_back(mirrored(scene.surfaces[surface], longer.image.back()));
      result.push_back(std::move(longer));
    }
  return result;
}

// Tells whether the point of a reflection lies in another surface's plane too, so that both reflect in a corner, one
// after the other, with no leg between.
bool in_plane_too(const Scene& scene, uint32_t surface, const Vertex& next) {
  const Surface &here = scene.surfaces[surface], &there = scene.surfaces[next.number];
  return std::abs(height(here, next.point)) <= corner_tolerance * (1 + glm::length(next.point)) &&
         glm::length(glm::cross(here.normal, there.normal)) > 1e-3;
}

// The reflections of a chain on the way from its end to the target, or nothing if a point is outside of its surface.
std::optional<Path> unfolded(const Scene& scene, const Chain& chain, dvec3 target) {
  Path path(chain.surfaces.size());
  for (size_t k = path.size(); k > 0; --k) {
    const uint32_t surface = chain.surfaces[k - 1];
    const bool corner = k < path.size() && in_plane_too(scene, surface, path[k]);
    const auto hit = corner ? target : crossing(scene.surfaces[surface], chain.image[k], target);
    if (!hit || !inside_surface(scene, surface, *hit)) return std::nullopt;
    path[k - 1] = {reflection, surface, *hit};
    target = *hit;
  }
  return path;
}

// From the transmitter's chain over the bends at wedges to the receiver's chain.
std::optional<Path> joined(const Scene& scene, const Chain& from, const Path& bends, const Chain& to) {
  auto path = unfolded(scene, from, bends.front().point);
  if (!path) return std::nullopt;
  const auto rest = unfolded(scene, to, bends.back().point);
  if (!rest) return std::nullopt;
  path->insert(path->end(), bends.begin(), bends.end());
  path->insert(path->end(), rest->rbegin(), rest->rend());
  return path;
}

// Tells whether there is a direction in which a surface continues from its point p in front of another surface, on the
// side of `front`. It searches a millimetre around p.
bool goes_on(const Scene& scene, uint32_t surface, const dvec3& p, const dvec3& front) {
  const dvec3 normal = scene.surfaces[surface].normal;
  const dvec3 u = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5 ? dvec3{1, 0, 0} : dvec3{0, 1, 0}));
  const dvec3 v = glm::cross(normal, u);
  for (int degree = 0; degree < 360; ++degree) {
    const dvec3 direction = std::cos(glm::radians(1.0 * degree)) * u + std::sin(glm::radians(1.0 * degree)) * v;
    if (glm::dot(direction, front) > 1e-3 && inside_surface(scene, surface, p + 1e-3 * direction)) return true;
  }
  return false;
}

// For reflection k of a path, seen from `before`: tells whether all other surfaces in its corner continue in front of
// it.
bool corner_opens(const Scene& scene, const Path& bends, size_t k, const dvec3& before) {
  const Surface& surface = scene.surfaces[bends[k].number];
  const dvec3 front = height(surface, before) > 0 ? surface.normal : -surface.normal;
  const auto near = [&](size_t j) {
    return bends[j].kind == reflection && glm::distance(bends[j].point, bends[k].point) <= same_vertex_m;
  };
  size_t first = k, end = k + 1;
  while (first > 0 && near(first - 1)) --first;
  while (end < bends.size() && near(end)) ++end;
  for (size_t j = first; j < end; ++j)
    if (bends[j].number != bends[k].number && !goes_on(scene, bends[j].number, bends[j].point, front)) return false;
  return true;
}

bool bends_rightly(const Scene& scene, const Vertex& vertex, const dvec3& before, const dvec3& after) {
  if (vertex.kind == reflection) {
    const Surface& surface = scene.surfaces[vertex.number];
    return height(surface, before) * height(surface, after) > 0;
  }
  if (std::min(glm::distance(before, vertex.point), glm::distance(vertex.point, after)) < same_vertex_m) return false;
  const Wedge& wedge = scene.wedges[vertex.number];
  return in_free_sector(wedge, vertex.point, before) && in_free_sector(wedge, vertex.point, after);
}

// Returns where the leg between a vertex and its neighbour begins: away from the face of a wedge that it is nearer to.
Stop stop_at(const Scene& scene, const Vertex& vertex, const dvec3& neighbour) {
  if (vertex.kind == reflection) {
    const Surface& surface = scene.surfaces[vertex.number];
    return {vertex.point, false, {vertex.number}, height(surface, neighbour) < 0 ? -surface.normal : surface.normal};
  }
  const Wedge& wedge = scene.wedges[vertex.number];
  const dvec3 way = neighbour - vertex.point;
  double azimuth = std::atan2(glm::dot(way, wedge.normal), glm::dot(way, wedge.face));
  if (azimuth < -1e-6) azimuth += 2 * std::numbers::pi;
  const double end = wedge.exterior_rad;
  const dvec3 front = azimuth <= end / 2 ? wedge.normal : std::sin(end) * wedge.face - std::cos(end) * wedge.normal;
  return {vertex.point, false, {wedge.surface[0], wedge.surface[1]}, front};
}

// Returns the path with its transmissions, or nothing if there is none.
std::optional<Path> checked(const Scene& scene, const Limits& limits, const dvec3& tx, const Path& bends,
                            const dvec3& rx) {
  if (bends.empty() && tx == rx) return std::nullopt;
  const auto point = [&](size_t k) { return k == 0 ? tx : k > bends.size() ? rx : bends[k - 1].point; };
  const auto stop = [&](size_t k, size_t neighbour) {
    return k == 0 || k > bends.size() ? Stop{point(k)} : stop_at(scene, bends[k - 1], point(neighbour));
  };
  // Legs of length zero, in corners, are skipped.
  const auto same = [&](size_t j, size_t k) {
    return bends[j - 1].kind == reflection && bends[k - 1].kind == reflection &&
           glm::distance(point(j), point(k)) <= corner_tolerance * (1 + glm::length(point(k)));
  };
  for (size_t k = 1; k <= bends.size(); ++k) {
    size_t before = k - 1, after = k + 1;
    while (before > 0 && same(before, k)) --before;
    while (after <= bends.size() && same(after, k)) ++after;
    if (!bends_rightly(scene, bends[k - 1], point(before), point(after))) return std::nullopt;
    if (bends[k - 1].kind == reflection && !corner_opens(scene, bends, k - 1, point(before))) return std::nullopt;
  }
  size_t transmissions = limits.transmission ? limits.max_transmissions : 0;  // left
  transmissions = std::min(transmissions, limits.max_depth - bends.size());
  Path path;
  for (size_t k = 0; k <= bends.size(); ++k) {
    if (k > 0) path.push_back(bends[k - 1]);
    if (point(k) == point(k + 1)) continue;  // in a corner
    const auto passed = passages(scene, stop(k > 0 ? k - 1 : 0, k), stop(k, k + 1), stop(k + 1, k));
    if (passed.size() > transmissions) return std::nullopt;
    transmissions -= passed.size();
    for (const Passage& passage : passed) path.push_back({transmission, passage.surface, passage.point});
  }
  return path;
}

// All bends at one wedge, or at two, between two chains; the points are found between their last images.
std::vector<Path> bends_between(const Scene& scene, const Limits& limits, std::span<const uint32_t> wedges,
                                const Chain& from, const Chain& to) {
  const dvec3 &a = from.image.back(), &b = to.image.back();
  const size_t reflections = from.surfaces.size() + to.surfaces.size();
  std::vector<Path> result;
  for (const uint32_t first : wedges) {
    const auto p = diffraction_point(scene.wedges[first], a, b);
    if (p && !is_faint(scene.wedges[first], a, b, limits.wavelength_m)) result.push_back({{diffraction, first, *p}});
    if (limits.max_diffractions < 2 || reflections + 2 > limits.max_depth) continue;
    for (const uint32_t second : wedges) {
      const Wedge &v = scene.wedges[first], &w = scene.wedges[second];
      if (second == first || is_corner(v) || is_corner(w)) continue;
      const auto q = diffraction_points(v, w, a, b);
      if (!q || is_faint(v, a, (*q)[1], limits.wavelength_m) || is_faint(w, (*q)[0], b, limits.wavelength_m)) continue;
      result.push_back({{diffraction, first, (*q)[0]}, {diffraction, second, (*q)[1]}});
    }
  }
  return result;
}

bool same_place(const Path& a, const Path& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Vertex& p, const Vertex& q) {
    return p.kind == q.kind && glm::distance(p.point, q.point) <= same_vertex_m;
  });
}

bool before(const Path& a, const Path& b) {
  const auto key = [](const Path& path) {
    std::vector<uint32_t> kinds, numbers;
    for (const Vertex& vertex : path) kinds.push_back(vertex.kind), numbers.push_back(vertex.number);
    return std::tuple(path.size(), kinds, numbers);
  };
  return key(a) < key(b);
}

void append(PathGeometry& paths, uint32_t tx, uint32_t rx, std::vector<Path> found) {
  std::sort(found.begin(), found.end(), before);
  std::vector<Path> kept;
  for (const Path& path : found) {
    if (std::any_of(kept.begin(), kept.end(), [&](const Path& other) { return same_place(other, path); })) continue;
    kept.push_back(path);
    paths.tx.push_back(tx);
    paths.rx.push_back(rx);
    for (const Vertex& vertex : path) {
      paths.surface.push_back(vertex.number);
      paths.interaction.push_back(vertex.kind);
      paths.vertex.push_back(vertex.point);
    }
    paths.first.push_back(paths.vertex.size());
  }
}

}  // namespace

PathGeometry brute_force_all(const Scene& scene, const Points& transmitters, const Points& receivers,
                             const Limits& limits) {
  std::vector<uint32_t> wedges;
  for (uint32_t i = 0; i < scene.wedges.size() && limits.diffraction; ++i)
    if (limits.free_edges || scene.wedges[i].surface[0] != scene.wedges[i].surface[1]) wedges.push_back(i);
  const size_t reflections = limits.reflection ? limits.max_depth : 0;
  const bool bends = !wedges.empty() && limits.max_diffractions > 0 && limits.max_depth > 0;
  PathGeometry paths;
  for (uint32_t tx = 0; tx < transmitters.size(); ++tx) {
    const std::vector<Chain> out = chains(scene, transmitters[tx], reflections);
    for (uint32_t rx = 0; rx < receivers.size(); ++rx) {
      std::vector<Path> found;
      const auto keep = [&](const std::optional<Path>& path) {
        if (!path) return;
        if (auto complete = checked(scene, limits, transmitters[tx], *path, receivers[rx]))
          found.push_back(std::move(*complete));
      };
      for (const Chain& from : out) keep(unfolded(scene, from, receivers[rx]));
      for (const Chain& to : bends ? chains(scene, receivers[rx], std::min<size_t>(reflections, limits.max_depth - 1))
                                   : std::vector<Chain>{})
        for (const Chain& from : out) {
          if (from.surfaces.size() + 1 + to.surfaces.size() > limits.max_depth) break;
          for (const Path& wedge_points : bends_between(scene, limits, wedges, from, to))
            keep(joined(scene, from, wedge_points, to));
        }
      append(paths, tx, rx, std::move(found));
    }
  }
  return paths;
}

PathGeometry brute_force_paths(const Scene& scene, const Points& transmitters, const Points& receivers,
                               uint32_t max_order) {
  return brute_force_all(scene, transmitters, receivers, {.max_depth = max_order});
}

double path_length_m(const PathGeometry& paths, size_t i, const dvec3& transmitter, const dvec3& receiver) {
  double length = 0;
  dvec3 from = transmitter;
  for (uint64_t k = paths.first[i]; k < paths.first[i + 1]; ++k) {
    length += glm::distance(from, paths.vertex[k]);
    from = paths.vertex[k];
  }
  return length + glm::distance(from, receiver);
}

}  // namespace wavetracer::reference
