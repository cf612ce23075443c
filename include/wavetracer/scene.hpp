// SPDX-License-Identifier: Apache-2.0
// The geometry of a scene: welded triangles, the planar surfaces that they form, edges and materials.
// All coordinates are double, in metres, recentred: file coordinate = origin_m + coordinate.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace wavetracer {

// Attenuation by leaves and twigs over d metres inside: A = A_m (1 - exp(-g d / A_m)) dB (ITU-R P.833-10, equation 1).
// If g and A_m are not given, they are the recommendation's, at the carrier (host/radio/vegetation_law.hpp).
struct VegetationLaw {
  bool deciduous = false;  // selects A_m: that of a deciduous wood, or of a mixed one
  bool in_leaf = true;
  std::optional<double> attenuation_db_m = {};    // g
  std::optional<double> max_attenuation_db = {};  // A_m; infinity: no maximum
  bool operator==(const VegetationLaw&) const = default;
};

// A radio material before a frequency is chosen: eps' = a f^b, sigma = c f^d (S/m), f in GHz (ITU-R P.2040-3, Table 3).
// A material of fixed permittivity and conductivity has b = d = 0 and a range of 0 to infinity.
struct Material {
  std::string name;  // "concrete", or the user's own
  double a = 1, b = 0, c = 0, d = 0;
  double min_ghz = 0, max_ghz = std::numeric_limits<double>::infinity();
  double thickness_m = 0.1;  // infinity: a half space
  // Diffuse scattering (V. Degli-Esposti et al., IEEE Trans. Antennas Propag. 55(1), 2007), with trace.scattering.
  double scattering = 0;                         // S: the share S^2 of the reflected power is scattered, 0 to 1
  double scattering_lobe = 0;                    // exponent of the directive lobe; 0: Lambertian
  double scattering_cross_polar = 0;             // share of the scattered power in the other polarisation, 0 to 1
  std::optional<VegetationLaw> vegetation = {};  // if set, its meshes are volumes, and only its name counts besides
  // The layers of a wall from its outer side inwards, two or more, which have no layers themselves. The law is then
  // that of the first one, and thickness_m the sum of theirs; both are for exports alone.
  std::vector<Material> layers = {};
  bool operator==(const Material&) const = default;
};

// Coplanar triangles of one material, which are connected except where parts were cut out. The plane is dot(normal, p)
// = offset_m.
struct Surface {
  glm::dvec3 normal{0, 0, 1};
  double offset_m = 0;
  glm::dvec3 lower{0}, upper{0};  // bounding box
  uint32_t material = 0;          // index into Scene::materials
  uint32_t object = 0;            // index into Scene::objects: the object of its largest triangle
  uint32_t first_triangle = 0;    // into Scene::surface_triangles
  uint32_t triangle_count = 0;
  bool outer_is_below = false;  // for a wall of layers: its normal points away from the outer side (wall_sides.hpp)
};

// An edge of the welded mesh. Faces are triangle indices in Scene::edge_faces.
struct Edge {
  std::array<uint32_t, 2> vertices;
  uint32_t first_face = 0, face_count = 0;
  // True if all faces at it lie in one plane, on both sides: it does not diffract. A free edge is never flat.
  bool flat = false;
};

// A straight edge at which waves diffract: one physical edge, even if its faces belong to several meshes
// (host/scene/scene_wedges.hpp has the rule). Its two faces bound a sector of free space, wider than pi, or narrower (a
// corner); the azimuth of a direction d about the edge is atan2(dot(d, normal), dot(d, face)) in [0, 2 pi), and free
// space reaches from 0 (face 0) to exterior_rad (face 1).
struct Wedge {
  glm::dvec3 start{0}, along{0, 0, 1};  // unit; (face, normal, along) is right-handed
  double length_m = 0;
  glm::dvec3 face{1, 0, 0};    // unit, normal to along: from the edge into face 0
  glm::dvec3 normal{0, 1, 0};  // normal of face 0, into free space
  double exterior_rad = 0;     // n pi; 2 pi: a half plane
  // The surfaces of face 0 and face 1, indices into Scene::surfaces; both are the same for a free edge.
  std::array<uint32_t, 2> surface{0, 0};
  // For face 0 and face 1: the lowest of the surfaces that form one plane with it, see host/scene/face_planes.hpp.
  std::array<uint32_t, 2> plane{0, 0};
  // WT_FREE_START, WT_FREE_END of wavetracer/device/records.h: free ends, which diffract too
  // (host/scene/free_ends.hpp).
  uint32_t free_ends = 0;
};

// A volume of vegetation, which waves pass with attenuation.
enum class VolumeShape : uint32_t { box, cylinder, spheroid, mesh };  // as WT_VOLUME_... of wavetracer/device/volumes.h
struct Volume {
  VolumeShape shape = VolumeShape::box;
  // Centre and half size of its box, turned by yaw_rad about z; an upright cylinder is elliptic.
  glm::dvec3 centre{0}, half_size{0};
  double yaw_rad = 0;
  std::vector<std::array<glm::dvec3, 3>> triangles = {};  // for a mesh: closed, counter-clockwise seen from outside
  uint32_t material = 0;                                  // index into Scene::materials, which has a VegetationLaw
};

// A point that the file gives a name, such as the place of an antenna.
struct SceneNode {
  std::string name;
  glm::dvec3 position_m{0};
};

// Counts of everything that was left out when the scene was loaded; every count is reported to the user.
struct LoadReport {
  uint64_t degenerate_triangles = 0;  // zero area, dropped
  uint64_t duplicate_triangles = 0;   // same three welded vertices and material as an earlier one, dropped
  double covered_m2 = 0;         // area of surfaces that smaller ones of their plane cover (host/scene/cover_order.hpp)
  uint64_t welded_vertices = 0;  // vertices that were merged into another
  double plane_tolerance_m = 0;  // tolerance of vertices about the plane of their surface (host/scene/flatten.hpp)
  uint64_t flattened_vertices = 0;  // vertices that were moved onto their planes
  double flattened_by_m = 0;        // the largest move
  uint64_t bent_triangles = 0;      // triangles that stay off the plane that they belong to
  uint64_t nonmanifold_edges = 0;   // more than two faces
  uint64_t free_edges = 0;          // one face
  // Pieces of edges at which nothing diffracts (host/scene/scene_wedges.hpp), not counting edges that are flat:
  uint64_t flat_pieces = 0;    // pieces with two faces in one plane
  uint64_t corner_pieces = 0;  // pieces with three or more faces at right angles, such as the foot of a wall
  uint64_t ground_rims = 0;    // free edges at the rim of a scene's ground (host/scene/ground_sheets.hpp)
  std::vector<std::string> warnings;
};

struct Scene {
  std::string file;
  std::vector<std::string> files;  // the scene file and the files that it names; none if it was generated
  glm::dvec3 origin_m{0};
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<uint32_t> triangle_surface;  // per triangle
  std::vector<uint32_t> triangle_object;   // per triangle
  std::vector<Surface> surfaces;
  std::vector<uint32_t> surface_triangles;  // triangle indices, grouped by surface
  std::vector<Edge> edges;
  std::vector<uint32_t> edge_faces;
  std::vector<Wedge> wedges;  // includes free edges, even if trace.free_edges is off
  std::vector<Material> materials;
  std::vector<Volume> volumes;       // they are no surfaces: rays do not hit them
  std::vector<std::string> objects;  // mesh names
  std::vector<SceneNode> nodes;      // from a glTF or OBJ file, or a built-in vehicle; names may repeat
  glm::dvec3 lower{0}, upper{0};     // bounding box, recentred
  LoadReport report;
};

}  // namespace wavetracer
