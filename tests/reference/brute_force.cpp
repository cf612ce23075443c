// Image method over all sequences (as in McKown and Hamilton, "Ray tracing as a design tool for radio networks",
// IEEE Network 5(6), 1991), with no acceleration of any kind.
// Assumes exact planes: a surface's normal has unit length and its triangles lie in its plane.
#include "reference/brute_force.hpp"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace wavetracer::reference {
namespace {

using glm::dvec3;

constexpr double border_tolerance = 1e-9;  // of a triangle's longest side
constexpr double plane_distance_m = 1e-4;  // ends nearer to a plane than this are not behind it
constexpr double same_vertex_m = 1e-4;
constexpr uint32_t no_surface = 0xFFFFFFFFu;  // the "surface" of a transmitter or receiver

using Sequence = std::vector<uint32_t>;
using Points = std::vector<dvec3>;

double height(const Surface& surface, const dvec3& point) { return glm::dot(surface.normal, point) - surface.offset_m; }

dvec3 mirrored(const Surface& surface, const dvec3& point) {
  return point - 2.0 * height(surface, point) * surface.normal;
}

// The point is known to lie in the triangle's plane.
bool inside_triangle(const std::array<dvec3, 3>& corner, const dvec3& point) {
  const dvec3 normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
  double size = 0;
  for (int i = 0; i < 3; ++i) size = std::max(size, glm::distance(corner[i], corner[(i + 1) % 3]));
  for (int i = 0; i < 3; ++i) {
    const dvec3 side = corner[(i + 1) % 3] - corner[i];
    const double distance = glm::dot(glm::cross(normal, side), point - corner[i]) / glm::length(side);
    if (distance < -border_tolerance * size) return false;
  }
  return true;
}

bool inside_surface(const Scene& scene, uint32_t index, const dvec3& point) {
  const Surface& surface = scene.surfaces[index];
  for (uint32_t i = 0; i < surface.triangle_count; ++i) {
    const auto& corners = scene.triangles[scene.surface_triangles[surface.first_triangle + i]];
    if (inside_triangle({scene.vertices[corners[0]], scene.vertices[corners[1]], scene.vertices[corners[2]]}, point))
      return true;
  }
  return false;
}

// Where the line from a to b meets the plane, if that is strictly between them.
std::optional<dvec3> crossing(const Surface& surface, const dvec3& a, const dvec3& b) {
  const double from = height(surface, a), to = height(surface, b);
  if (from * to >= 0) return std::nullopt;
  return a + (b - a) * (from / (from - to));
}

bool blocked(const Scene& scene, const dvec3& a, uint32_t a_surface, const dvec3& b, uint32_t b_surface) {
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (i == a_surface || i == b_surface) continue;
    if (std::abs(height(surface, a)) <= plane_distance_m || std::abs(height(surface, b)) <= plane_distance_m) continue;
    const auto point = crossing(surface, a, b);
    if (point && inside_surface(scene, i, *point)) return true;
  }
  return false;
}

// The reflection points of a sequence, transmitter's side first, or nothing if it is not a path.
std::optional<Points> solve(const Scene& scene, const Sequence& sequence, const dvec3& tx, const dvec3& rx) {
  const size_t order = sequence.size();
  Points image{tx};  // image[k]: the transmitter mirrored by the first k surfaces
  for (const uint32_t surface : sequence) image.push_back(mirrored(scene.surfaces[surface], image.back()));
  Points point(order + 2);
  point.front() = tx;
  point.back() = rx;
  for (size_t k = order; k > 0; --k) {
    const auto hit = crossing(scene.surfaces[sequence[k - 1]], image[k], point[k + 1]);
    if (!hit || !inside_surface(scene, sequence[k - 1], *hit)) return std::nullopt;
    point[k] = *hit;
  }
  for (size_t k = 1; k <= order; ++k) {
    const Surface& surface = scene.surfaces[sequence[k - 1]];
    if (height(surface, point[k - 1]) * height(surface, point[k + 1]) <= 0) return std::nullopt;
  }
  for (size_t k = 0; k <= order; ++k) {
    const uint32_t from = k == 0 ? no_surface : sequence[k - 1], to = k == order ? no_surface : sequence[k];
    if (blocked(scene, point[k], from, point[k + 1], to)) return std::nullopt;
  }
  return Points(point.begin() + 1, point.end() - 1);
}

bool same_points(const Points& a, const Points& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const dvec3& p, const dvec3& q) { return glm::distance(p, q) <= same_vertex_m; });
}

// Counts through all sequences of one length in lexicographic order, those with immediate repeats included.
bool advance(Sequence& sequence, uint32_t surface_count) {
  for (size_t k = sequence.size(); k > 0; --k) {
    if (++sequence[k - 1] < surface_count) return true;
    sequence[k - 1] = 0;
  }
  return false;
}

void append(PathGeometry& paths, uint32_t tx, uint32_t rx, const Sequence& sequence, const Points& points) {
  paths.tx.push_back(tx);
  paths.rx.push_back(rx);
  paths.surface.insert(paths.surface.end(), sequence.begin(), sequence.end());
  paths.interaction.insert(paths.interaction.end(), sequence.size(), uint8_t{1});  // Interaction::reflection
  paths.vertex.insert(paths.vertex.end(), points.begin(), points.end());
  paths.first.push_back(paths.vertex.size());
}

}  // namespace

PathGeometry brute_force_paths(const Scene& scene, const std::vector<dvec3>& transmitters,
                               const std::vector<dvec3>& receivers, uint32_t max_order) {
  const uint32_t surface_count = static_cast<uint32_t>(scene.surfaces.size());
  PathGeometry paths;
  for (uint32_t tx = 0; tx < transmitters.size(); ++tx)
    for (uint32_t rx = 0; rx < receivers.size(); ++rx)
      for (uint32_t order = 0; order <= max_order && (order == 0 || surface_count > 0); ++order) {
        std::vector<Points> kept;
        Sequence sequence(order, 0);
        do {
          if (std::adjacent_find(sequence.begin(), sequence.end()) != sequence.end()) continue;
          const auto points = solve(scene, sequence, transmitters[tx], receivers[rx]);
          if (!points ||
              std::any_of(kept.begin(), kept.end(), [&](const Points& p) { return same_points(p, *points); }))
            continue;
          kept.push_back(*points);
          append(paths, tx, rx, sequence, *points);
        } while (advance(sequence, surface_count));
      }
  return paths;
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
