// A scene as geometry sees it: welded triangles, the planar surfaces they form, edges and materials.
// All coordinates are double, in metres, recentred: file coordinate = origin_m + coordinate.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

namespace wavetracer {

// A radio material before a frequency is chosen: eps' = a f^b, sigma = c f^d (S/m), f in GHz (ITU-R P.2040-3, Table 3).
// A material of fixed permittivity and conductivity has b = d = 0 and a range of 0 to infinity.
struct Material {
  std::string name;  // "concrete", or the user's own
  double a = 1, b = 0, c = 0, d = 0;
  double min_ghz = 0, max_ghz = std::numeric_limits<double>::infinity();
  double thickness_m = 0.1;  // infinity: a half space
  bool operator==(const Material&) const = default;
};

// Coplanar, edge-connected triangles of one material. The plane is dot(normal, p) = offset_m.
struct Surface {
  glm::dvec3 normal{0, 0, 1};
  double offset_m = 0;
  glm::dvec3 lower{0}, upper{0};  // bounding box
  uint32_t material = 0;          // index into Scene::materials
  uint32_t object = 0;            // index into Scene::objects: the object of its largest triangle
  uint32_t first_triangle = 0;    // into Scene::surface_triangles
  uint32_t triangle_count = 0;
};

// An edge of the welded mesh. Faces are triangle indices in Scene::edge_faces.
struct Edge {
  std::array<uint32_t, 2> vertices;
  uint32_t first_face = 0, face_count = 0;
  // Faces on both sides of it, all in one plane: nothing there diffracts. A free edge is never flat.
  bool flat = false;
};

// What the loader left out, and why; every count is reported to the user.
struct LoadReport {
  uint64_t degenerate_triangles = 0;  // zero area, dropped
  uint64_t duplicate_triangles = 0;   // same three welded vertices as an earlier one, dropped
  uint64_t welded_vertices = 0;       // vertices that were merged into another
  uint64_t nonmanifold_edges = 0;     // more than two faces
  uint64_t free_edges = 0;            // one face
  std::vector<std::string> warnings;
};

struct Scene {
  std::string file;
  glm::dvec3 origin_m{0};
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> triangle_surface;  // per triangle
  std::vector<uint32_t> triangle_object;   // per triangle
  std::vector<Surface> surfaces;
  std::vector<uint32_t> surface_triangles;  // triangle indices, grouped by surface
  std::vector<Edge> edges;
  std::vector<uint32_t> edge_faces;
  std::vector<Material> materials;
  std::vector<std::string> objects;  // mesh names
  glm::dvec3 lower{0}, upper{0};     // bounding box, recentred
  LoadReport report;
};

}  // namespace wavetracer
