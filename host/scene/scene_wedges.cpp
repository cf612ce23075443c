// SPDX-License-Identifier: Apache-2.0
// Faces are found by probing beside the middle of a piece, sectors by sorting angles.
// Planes are those of surfaces, so slivers of a wall do not turn its faces.
#include "scene/scene_wedges.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <optional>

#include "scene/edge_pieces.hpp"
#include "scene/face_planes.hpp"
#include "scene/ground_sheets.hpp"
#include "scene/thin_walls.hpp"
#include "scene/topology.hpp"
#include "scene/triangle_grid.hpp"
#include "scene/wedge_rows.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;
// A face that ends at a piece may end up to 2 mm beside it, on either side: at twice that distance it is clear whether
// a face is there.
constexpr double probe_m = 2 * touch_m;
static_assert(thin_wall_m >= touch_m);
constexpr double inside_m = 1e-6;         // probes on the border between two triangles are in both
constexpr double right_angle_rad = 3e-6;  // walls of 10 m whose corners are off by half a unit of float32 at 1 km
constexpr double on_planes_m = 1e-7;      // an edge that is so near to the planes of its faces keeps its bits
constexpr double most_rounded_m = 5e-4;   // faces whose planes are farther from an edge do not end there by rounding
constexpr double least_sine2 = 0.1;       // planes at a smaller angle tell little of where their line is
constexpr double most_lean = 0.1;         // sine: a plane that leans more does not hold a piece, however short that is

struct HalfPlane {
  double angle_rad;  // angle about the piece
  dvec3 direction;   // unit vector, from the piece into the face
  uint32_t surface;
};

class FaceFinder {
 public:
  explicit FaceFinder(const Scene& scene)
      : scene_(scene), triangles_(scene, probe_m), pieces_(split_edges(scene, triangles_.grid())) {}

  std::span<const EdgePiece> pieces() const { return pieces_.pieces; }
  const TriangleGrid& triangles() const { return triangles_; }

  // Returns the half planes that start at a piece, sorted by angle; if several have one direction, the lowest surface
  // comes first.
  std::vector<HalfPlane> faces(const EdgePiece& piece) const {
    std::vector<HalfPlane> found;
    add_ending(piece, found);
    add_passing(piece, found);
    if (found.empty()) return found;
    const dvec3 zero = found[0].direction, quarter = glm::cross(piece.along, zero);
    for (HalfPlane& face : found) {
      const double angle_rad = std::atan2(glm::dot(face.direction, quarter), glm::dot(face.direction, zero));
      face.angle_rad = angle_rad < -same_plane_rad ? angle_rad + 2 * pi : angle_rad;
    }
    std::sort(found.begin(), found.end(), [](const HalfPlane& a, const HalfPlane& b) {
      return a.angle_rad != b.angle_rad ? a.angle_rad < b.angle_rad : a.surface < b.surface;
    });
    return found;
  }

 private:
  // Adds those of triangles with an edge along the piece.
  void add_ending(const EdgePiece& piece, std::vector<HalfPlane>& found) const {
    for (uint32_t i = 0; i < piece.edge_count; ++i) {
      const Edge& edge = scene_.edges[pieces_.edges[piece.first_edge + i]];
      for (uint32_t k = 0; k < edge.face_count; ++k) {
        const uint32_t t = scene_.edge_faces[edge.first_face + k], surface = scene_.triangle_surface[t];
        const std::optional<dvec3> side = across_piece(piece, surface);
        if (!side) continue;
        const dvec3& top = scene_.vertices[apex(scene_, t, edge)];
        const bool behind = glm::dot(*side, top - scene_.vertices[edge.vertices[0]]) < 0;
        found.push_back({0, behind ? -*side : *side, surface});
      }
    }
  }

  // Adds those of triangles in whose plane the piece lies, on the sides where the triangles are.
  void add_passing(const EdgePiece& piece, std::vector<HalfPlane>& found) const {
    const dvec3 middle = (piece.start + piece.end) / 2.0;
    for (const uint32_t t : triangles_[triangles_.grid().cell_at(middle)]) {
      const SceneBox& box = triangles_.boxes()[t];
      if (glm::any(glm::lessThan(middle, box.lower)) || glm::any(glm::greaterThan(middle, box.upper))) continue;
      const uint32_t surface = scene_.triangle_surface[t];
      if (!lies_in(piece.start, surface) || !lies_in(piece.end, surface)) continue;
      const std::optional<dvec3> side = across_piece(piece, surface);
      if (!side) continue;
      for (const dvec3& direction : {*side, -*side}) {
        if (holds(t, middle + direction * probe_m)) found.push_back({0, direction, surface});
      }
    }
  }

  // Returns the direction in the plane of a surface that is normal to a piece in it.
  std::optional<dvec3> across_piece(const EdgePiece& piece, uint32_t surface) const {
    const dvec3& normal = scene_.surfaces[surface].normal;
    if (std::abs(glm::dot(normal, piece.along)) > most_lean) return std::nullopt;
    return glm::normalize(glm::cross(normal, piece.along));
  }

  bool lies_in(const dvec3& p, uint32_t surface) const {
    return std::abs(glm::dot(scene_.surfaces[surface].normal, p) - scene_.surfaces[surface].offset_m) <= touch_m;
  }

  // Tells whether a point in the plane of triangle t is inside the triangle.
  bool holds(uint32_t t, const dvec3& p) const {
    const dvec3& normal = scene_.surfaces[scene_.triangle_surface[t]].normal;
    bool left = true, right = true;  // the point is on this side of all edges
    for (size_t k = 0; k < 3; ++k) {
      const dvec3 &a = scene_.vertices[scene_.triangles[t][k]], &b = scene_.vertices[scene_.triangles[t][(k + 1) % 3]];
      const double distance_m = glm::dot(normal, glm::cross(b - a, p - a)) / glm::distance(a, b);
      left &= distance_m >= -inside_m;
      right &= distance_m <= inside_m;
    }
    return left || right;
  }

  const Scene& scene_;
  TriangleGrid triangles_;
  EdgePieces pieces_;
};

// Tells whether the previous face, in circular order, is more than 1 mrad away.
bool begins_wall(std::span<const HalfPlane> faces, size_t i) {
  const double before_rad = i > 0 ? faces[i - 1].angle_rad : faces.back().angle_rad - 2 * pi;
  return faces[i].angle_rad - before_rad > same_angle_rad;
}

// A wall: half planes that are each within 1 mrad of the next, such as walls that touch back to back. Nothing is
// between them.
using Wall = std::span<const HalfPlane>;

// Returns the walls of half planes that are sorted by angle; a wall across the angle zero is kept in one piece.
std::vector<Wall> walls_of(std::vector<HalfPlane>& faces) {
  // The first face must begin a wall.
  size_t first = 0;
  while (first + 1 < faces.size() && !begins_wall(faces, first)) ++first;
  for (size_t i = 0; i < first; ++i) faces[i].angle_rad += 2 * pi;
  std::rotate(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end());
  std::vector<Wall> walls;
  for (size_t i = 0, from = 0; i < faces.size(); ++i) {
    if (i + 1 < faces.size() && faces[i + 1].angle_rad - faces[i].angle_rad <= same_angle_rad) continue;
    walls.push_back(Wall(faces).subspan(from, i + 1 - from));
    from = i + 1;
  }
  return walls;
}

// Returns the face on the first or the last side of a wall; if several lie in one plane, that of the lowest surface.
HalfPlane outer_face(Wall wall, bool last) {
  HalfPlane out = last ? wall.back() : wall.front();
  for (const HalfPlane& face : wall)
    if (std::abs(face.angle_rad - out.angle_rad) <= same_plane_rad && face.surface < out.surface) out = face;
  return out;
}

// A sector of free space, from its face 0 to its face 1.
struct Sector {
  HalfPlane from, to;
  double angle_rad;
};

// Returns the sectors between neighbouring walls.
std::vector<Sector> sectors_of(std::span<const Wall> walls) {
  std::vector<Sector> sectors;
  for (size_t i = 0; i < walls.size(); ++i) {
    const bool around = i + 1 == walls.size();
    const HalfPlane from = outer_face(walls[i], true), to = outer_face(walls[around ? 0 : i + 1], false);
    sectors.push_back({from, to, (around ? to.angle_rad + 2 * pi : to.angle_rad) - from.angle_rad});
  }
  return sectors;
}

// See rule 3 of scene_wedges.hpp.
bool diffracts(const Sector& sector) {
  return std::abs(sector.angle_rad - pi) > same_plane_rad && std::abs(sector.angle_rad - pi / 2) > right_angle_rad;
}

// Joins surfaces whose faces at a piece lie in one plane with nothing between them: within a wall, or across a sector
// of about 180 degrees.
void join_planes(const EdgePiece& piece, std::span<const Wall> walls, std::span<const Sector> sectors,
                 FacePlanes& planes) {
  for (size_t i = 0; i < sectors.size(); ++i) {
    const HalfPlane &from = sectors[i].from, &to = sectors[i].to;
    const dvec3 front = glm::cross(piece.along, from.direction), last = glm::cross(to.direction, piece.along);
    for (const HalfPlane& face : walls[i]) planes.join(from.surface, face.surface, front, piece.start);
    for (const HalfPlane& face : walls[(i + 1) % walls.size()])
      planes.join(to.surface, face.surface, last, piece.start);
    if (std::abs(sectors[i].angle_rad - pi) <= same_angle_rad)
      planes.join(from.surface, to.surface, front, piece.start);
  }
}

Wedge wedge_at(const EdgePiece& piece, const Sector& sector) {
  return {.start = piece.start,
          .along = piece.along,
          .length_m = glm::distance(piece.start, piece.end),
          .face = sector.from.direction,
          .normal = glm::cross(piece.along, sector.from.direction),
          .exterior_rad = sector.angle_rad,
          .surface = {sector.from.surface, sector.to.surface}};
}

// Moves an edge onto the planes of its faces. Corners of files are beside these planes by rounding, and mirrors end on
// their planes: there the wave that the edge diffracts must take their place.
void put_on_planes(const Scene& scene, Wedge& wedge) {
  const auto &a = scene.surfaces[wedge.surface[0]], &b = scene.surfaces[wedge.surface[1]];
  const double cosine = glm::dot(a.normal, b.normal), sine2 = 1 - cosine * cosine;
  const bool one_face = wedge.surface[0] == wedge.surface[1];
  if (!one_face && sine2 < least_sine2) return;  // their line is not known well
  const auto moved = [&](const dvec3& p) {
    const double off_a = glm::dot(a.normal, p) - a.offset_m, off_b = glm::dot(b.normal, p) - b.offset_m;
    if (one_face) return p - off_a * a.normal;
    return p - ((off_a - cosine * off_b) * a.normal + (off_b - cosine * off_a) * b.normal) / sine2;
  };
  const dvec3 from = wedge.start, to = wedge.start + wedge.along * wedge.length_m;
  const dvec3 start = moved(from), end = moved(to);
  const double off_m = std::max(glm::distance(from, start), glm::distance(to, end));
  if (off_m < on_planes_m || off_m > most_rounded_m) return;
  wedge.start = start;
  wedge.along = glm::normalize(end - start);
  wedge.length_m = glm::distance(start, end);
  const dvec3 across = glm::normalize(glm::cross(a.normal, wedge.along));
  wedge.face = glm::dot(across, wedge.face) < 0 ? -across : across;
  wedge.normal = glm::cross(wedge.along, wedge.face);
}

}  // namespace

void find_wedges(Scene& scene, EdgeSearch search) {
  scene.wedges.clear();
  scene.report.flat_pieces = scene.report.corner_pieces = scene.report.ground_rims = 0;
  if (search == EdgeSearch::none) return;
  const FaceFinder finder(scene);
  GroundRims rims(scene);
  FacePlanes planes(scene);
  std::vector<WedgePiece> convex, concave;
  for (const EdgePiece& piece : finder.pieces()) {
    std::vector<HalfPlane> faces = finder.faces(piece);
    for (const HalfPlane& face : faces) rims.join(faces[0].surface, face.surface);
    const std::vector<Wall> walls = walls_of(faces);
    const std::vector<Sector> sectors = sectors_of(walls);
    join_planes(piece, walls, sectors, planes);
    const size_t before = convex.size() + concave.size();
    for (const Sector& sector : sectors)
      if (diffracts(sector))
        (sector.angle_rad > pi ? convex : concave).push_back({piece.joints, wedge_at(piece, sector)});
    if (convex.size() + concave.size() == before)
      ++(walls.size() > 2 ? scene.report.corner_pieces : scene.report.flat_pieces);
  }
  scene.wedges = join_rows(convex);
  const std::vector<Wedge> corners = join_rows(concave);
  scene.wedges.insert(scene.wedges.end(), corners.begin(), corners.end());
  for (Wedge& wedge : scene.wedges) put_on_planes(scene, wedge);
  planes.number(scene.wedges);
  if (search == EdgeSearch::of_scene)
    scene.report.ground_rims =
        std::erase_if(scene.wedges, [&](const Wedge& wedge) { return rims.are_of(wedge, finder.triangles()); });
}

}  // namespace wavetracer
