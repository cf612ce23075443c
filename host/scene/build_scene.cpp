// SPDX-License-Identifier: Apache-2.0
// Builds a Scene in steps: gather, recentre, weld, clean, flatten, connect, cut covered faces, find wedges. Every step
// is deterministic and sequential; a million triangles take a few seconds.
#include "scene/build_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <tuple>

#include "scene/covered_faces.hpp"
#include "scene/earlier_faces.hpp"
#include "scene/flatten.hpp"
#include "scene/scene_warnings.hpp"
#include "scene/scene_wedges.hpp"
#include "scene/thin_walls.hpp"
#include "scene/topology.hpp"
#include "scene/volume_overlaps.hpp"
#include "scene/volumes.hpp"
#include "scene/wall_sides.hpp"
#include "scene/weld.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr uint32_t unmoved = 0xFFFFFFFFu;
// Rays on a flat Earth reach no farther: a larger scene has a wrong unit or a stray vertex.
constexpr double largest_extent_m = 1e6;
// Corners within 1 mm are merged, and points within 0.1 mm of a plane lie on it. In scenes smaller than the first
// extent these tolerances would change which paths exist; up to the second extent they may blur details.
constexpr double smallest_extent_m = 0.1, detailed_extent_m = 1;

// Vertices and triangles of all meshes in one index space; vertices that no triangle uses are left out.
struct Soup {
  std::vector<dvec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<uint32_t> object;    // the mesh of each triangle
  std::vector<double> rounding_m;  // the rounding of the mesh of each vertex
};

// Gathers all meshes but those of vegetation.
Soup gather(const RawScene& raw, const ResolvedMaterials& resolved) {
  const auto is_volume = [&](size_t m) { return resolved.materials[resolved.mesh_material[m]].vegetation.has_value(); };
  uint64_t corners = 0;
  for (size_t m = 0; m < raw.meshes.size(); ++m)
    if (!is_volume(m)) corners += raw.meshes[m].triangles.size() * 3;
  if (corners == 0) throw InputError(fmt::format("{}: the scene has no triangles", raw.file));
  if (corners >= unmoved)
    throw InputError(
        fmt::format("{}: {} triangles are too many for 32-bit indices: make the scene smaller", raw.file, corners / 3));
  Soup soup;
  soup.triangles.reserve(corners / 3);
  soup.object.reserve(corners / 3);
  std::vector<uint32_t> moved;  // soup vertex of each mesh vertex
  for (size_t m = 0; m < raw.meshes.size(); ++m) {
    if (is_volume(m)) continue;
    const RawMesh& mesh = raw.meshes[m];
    moved.assign(mesh.vertices.size(), unmoved);
    for (Triangle t : mesh.triangles) {
      for (uint32_t& v : t) {
        if (moved[v] == unmoved) {
          moved[v] = static_cast<uint32_t>(soup.vertices.size());
          soup.vertices.push_back(mesh.vertices[v]);
          soup.rounding_m.push_back(mesh.rounding);
        }
        v = moved[v];
      }
      soup.triangles.push_back(t);
      soup.object.push_back(static_cast<uint32_t>(m));
    }
  }
  return soup;
}

// Moves the soup so that its bounding box is centred on a point of whole metres, and returns that point. For
// coordinates far from zero, such as UTM, the subtraction is exact, since a whole number is a multiple of their last
// bit.
dvec3 recentre(Soup& soup, const std::string& file) {
  dvec3 lower(std::numeric_limits<double>::max()), upper(-lower);
  for (const dvec3& v : soup.vertices) {
    lower = glm::min(lower, v);
    upper = glm::max(upper, v);
  }
  const dvec3 size = upper - lower;
  if (!(std::max({size.x, size.y, size.z}) <= largest_extent_m)) {
    throw InputError(
        fmt::format("{}: the scene extends over {:.3g} x {:.3g} x {:.3g} m, more than {:.0f} km: is scene.scale right, "
                    "or is there a stray vertex?",
                    file, size.x, size.y, size.z, largest_extent_m / 1000));
  }
  if (std::max({size.x, size.y, size.z}) < smallest_extent_m) {
    throw InputError(
        fmt::format("{}: the scene extends over {:.3g} x {:.3g} x {:.3g} m, less than {:g} m, which is too small, "
                    "because corners within 1 mm of each other are merged: is scene.scale right? "
                    "To trace a small model, scale scene, antennas and wavelength up by one factor",
                    file, size.x, size.y, size.z, smallest_extent_m));
  }
  const dvec3 origin = glm::round(lower + size * 0.5) + dvec3(0);  // adding 0 turns -0 into 0
  for (dvec3& v : soup.vertices) v -= origin;
  return origin;
}

void warn_small(Scene& scene) {
  const dvec3 size = scene.upper - scene.lower;
  if (const double extent_m = std::max({size.x, size.y, size.z}); extent_m < detailed_extent_m)
    scene.report.warnings.push_back(fmt::format(
        "the scene extends over {:.3g} m only, and details of less than 1 cm are not resolved: is scene.scale right?",
        extent_m));
}

// Finds triangles that have the same vertices, in any order, as an earlier triangle of the same material.
struct Duplicates {
  std::vector<bool> is_duplicate;
  uint64_t count = 0;
};

Duplicates find_duplicates(const std::vector<Triangle>& triangles, const std::vector<uint32_t>& material) {
  struct Key {
    Triangle corners;
    uint32_t material, triangle;
    bool repeats(const Key& other) const { return corners == other.corners && material == other.material; }
  };
  std::vector<Key> keys;
  keys.reserve(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    Triangle sorted = triangles[t];
    std::sort(sorted.begin(), sorted.end());
    keys.push_back({sorted, material[t], t});
  }
  std::ranges::sort(keys, {}, [](const Key& key) { return std::tie(key.corners, key.material, key.triangle); });
  Duplicates out;
  out.is_duplicate.resize(triangles.size());
  for (size_t i = 1; i < keys.size(); ++i) {
    if (!keys[i].repeats(keys[i - 1])) continue;
    out.is_duplicate[keys[i].triangle] = true;
    ++out.count;
  }
  return out;
}

// Welds the soup into the scene and drops degenerate and duplicate triangles. rounding_m: for every vertex of the
// scene, the largest rounding of the vertices welded into it.
void weld_and_clean(Scene& scene, const Soup& soup, const std::vector<uint32_t>& mesh_material,
                    std::vector<uint32_t>& triangle_material, std::vector<double>& rounding_m) {
  Weld weld = weld_vertices(soup.vertices, weld_tolerance_m);
  if (const uint64_t joined = join_thin_walls(soup.triangles, weld); joined > 0)
    scene.report.warnings.push_back(fmt::format(
        "both sides of walls of at most {:g} mm are one sheet: {} vertices were merged", thin_wall_m * 1000, joined));
  scene.report.welded_vertices = soup.vertices.size() - weld.positions.size();
  if (weld.widest_m > 10 * weld_tolerance_m) {
    scene.report.warnings.push_back(
        fmt::format("vertices closer than {} mm form chains that were welded over {:.3g} m: is scene.scale right?",
                    weld_tolerance_m * 1000, weld.widest_m));
  }
  scene.vertices = std::move(weld.positions);
  rounding_m.assign(scene.vertices.size(), 0);
  for (size_t i = 0; i < soup.vertices.size(); ++i)
    rounding_m[weld.vertex[i]] = std::max(rounding_m[weld.vertex[i]], soup.rounding_m[i]);
  for (size_t i = 0; i < soup.triangles.size(); ++i) {
    const Triangle& t = soup.triangles[i];
    scene.triangles.push_back({weld.vertex[t[0]], weld.vertex[t[1]], weld.vertex[t[2]]});
    if (triangle_shape(scene, static_cast<uint32_t>(scene.triangles.size() - 1)).height_m < degenerate_height_m) {
      scene.triangles.pop_back();
      ++scene.report.degenerate_triangles;
      continue;
    }
    scene.triangle_object.push_back(soup.object[i]);
    triangle_material.push_back(mesh_material[soup.object[i]]);
  }
  const Duplicates duplicates = find_duplicates(scene.triangles, triangle_material);
  scene.report.duplicate_triangles += duplicates.count;
  size_t kept = 0;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    if (duplicates.is_duplicate[t]) continue;
    scene.triangles[kept] = scene.triangles[t];
    scene.triangle_object[kept] = scene.triangle_object[t];
    triangle_material[kept++] = triangle_material[t];
  }
  scene.triangles.resize(kept);
  scene.triangle_object.resize(kept);
  triangle_material.resize(kept);
}

// Warns of areas that several triangles of one plane cover: only one of them scatters there (earlier_faces.hpp).
void warn_of_covered_faces(Scene& scene) {
  if (std::ranges::none_of(scene.materials, [](const Material& m) { return m.scattering > 0 && !m.vegetation; }))
    return;
  if (const uint64_t covered = EarlierFaces(scene).count(); covered > 0)
    scene.report.warnings.push_back(fmt::format(
        "{} triangles lie on others of their plane; where they do, the first in the file scatters", covered));
}

void gather_volumes(Scene& scene, const RawScene& raw, const ResolvedMaterials& resolved) {
  for (size_t i = 0; i < raw.volumes.size(); ++i) {
    scene.volumes.push_back(raw.volumes[i].volume);
    scene.volumes.back().material = resolved.volume_material[i];
  }
  for (size_t m = 0; m < raw.meshes.size(); ++m) {
    const uint32_t material = resolved.mesh_material[m];
    if (!scene.materials[material].vegetation) continue;
    const std::vector<Volume> parts = mesh_volumes(raw.meshes[m], material, &scene.report);
    scene.volumes.insert(scene.volumes.end(), parts.begin(), parts.end());
  }
  settle_overlaps(scene.volumes, scene.report.warnings);
  for (Volume& volume : scene.volumes) {
    volume.centre -= scene.origin_m;
    for (auto& triangle : volume.triangles)
      for (dvec3& corner : triangle) corner -= scene.origin_m;
  }
}

}  // namespace

Scene build_scene(const RawScene& raw, ResolvedMaterials resolved, EdgeSearch edges, double tolerance_m) {
  Scene scene;
  scene.file = raw.file;
  scene.files = raw.files;
  scene.report.warnings = raw.warnings;
  std::move(resolved.warnings.begin(), resolved.warnings.end(), std::back_inserter(scene.report.warnings));
  for (const RawMesh& mesh : raw.meshes) scene.objects.push_back(mesh.name);

  Soup soup = gather(raw, resolved);
  scene.materials = std::move(resolved.materials);
  scene.origin_m = recentre(soup, raw.file);
  gather_volumes(scene, raw, resolved);
  for (const SceneNode& node : raw.nodes) scene.nodes.push_back({node.name, node.position_m - scene.origin_m});
  std::vector<uint32_t> triangle_material;
  std::vector<double> rounding_m;
  weld_and_clean(scene, soup, resolved.mesh_material, triangle_material, rounding_m);
  if (scene.triangles.empty()) throw InputError(fmt::format("{}: all triangles of the scene are degenerate", raw.file));
  std::vector<double> left_rounding_m;
  for (const uint32_t v : drop_unused_vertices(scene)) left_rounding_m.push_back(rounding_m[v]);

  const auto triangle_edges = find_edges(scene);
  const Flattened flat = flatten_scene(scene, triangle_edges, tolerance_m, left_rounding_m);
  find_surfaces(scene, triangle_material, triangle_edges, flat);
  find_outer_sides(scene, triangle_edges);
  cut_covered_faces(scene, triangle_edges);
  find_flat_edges(scene);
  find_wedges(scene, edges);
  scene.lower = scene.upper = scene.vertices[0];
  for (const dvec3& v : scene.vertices) {
    scene.lower = glm::min(scene.lower, v);
    scene.upper = glm::max(scene.upper, v);
  }
  warn_small(scene);
  if (std::string warning = unit_warning(scene); !warning.empty()) scene.report.warnings.push_back(std::move(warning));
  warn_of_covered_faces(scene);
  return scene;
}

}  // namespace wavetracer
