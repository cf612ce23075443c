// SPDX-License-Identifier: Apache-2.0
// Triangles keep their surface, surfaces their material and object, wedges their faces, so that a click can show them.
// Outlines are the edges that are not flat.
#include "viewer/scene_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "base/digits.hpp"
#include "scene/volume_surface.hpp"
#include "viewer/blocks.hpp"

namespace wavetracer {
namespace {

// A band has two vertices for each point of the centre line: to its left and to its right.
// At a bend both lie on the line that halves the angle, so that the band keeps its width, at sharp bends approximately.

constexpr size_t most_points = 500'000;  // about 16 MB of a page
constexpr double margin_m = 100;
constexpr double above_ground_m = 0.03;      // so that the ground does not hide the streets
constexpr double least_cosine = 0.5;         // for half a bend: bands of sharp bends get no spikes
constexpr double shortest_segment_m = 1e-3;  // shorter segments have no direction

glm::dvec2 flat(const glm::dvec3& p) { return {p.x, p.y}; }

// Removes points that repeat the one before.
std::vector<glm::dvec3> distinct(const std::vector<glm::dvec3>& line) {
  std::vector<glm::dvec3> out;
  for (const glm::dvec3& p : line)
    if (out.empty() || glm::distance(flat(out.back()), flat(p)) > shortest_segment_m) out.push_back(p);
  return out;
}

// Returns the vector to the left, from the centre line to the rim of the band at point k.
glm::dvec2 to_rim(const std::vector<glm::dvec3>& line, size_t k, double half_width_m) {
  const auto left = [&](size_t from) {
    const glm::dvec2 along = glm::normalize(flat(line[from + 1]) - flat(line[from]));
    return glm::dvec2(-along.y, along.x);
  };
  const glm::dvec2 before = left(k > 0 ? k - 1 : 0), after = left(std::min(k, line.size() - 2));
  const glm::dvec2 sum = before + after;
  const double length = glm::length(sum);
  if (length < 1e-9) return half_width_m * after;  // the street turns back
  return sum * (half_width_m / (length * std::max(length / 2, least_cosine)));
}

struct Bands {
  Packer vertices, triangles;
  uint32_t count = 0;  // number of vertices

  void add(const std::vector<glm::dvec3>& rims, const glm::dvec3& centre_m) {
    for (size_t k = 0; k < rims.size(); k += 2) {
      for (const size_t side : {k, k + 1}) vertices.add(rims[side] - centre_m + glm::dvec3(0, 0, above_ground_m));
      if (k + 2 < rims.size())
        for (const uint32_t corner : {0, 1, 2, 2, 1, 3}) triangles.add(count + corner);
      count += 2;
    }
  }
};

}  // namespace

nlohmann::json add_scene_blocks(const Scene& scene, const std::string& prefix, const glm::dvec3& from_centre_m,
                                bool free_edges, std::string& elements) {
  const auto add = [&](const char* name, const Packer& data) { elements += block_element(prefix + "_" + name, data); };
  Packer vertices, triangles, triangle_surface, surface_material, surface_object, outlines;
  for (const glm::dvec3& p : scene.vertices) vertices.add(p + from_centre_m);
  for (const auto& triangle : scene.triangles)
    for (const uint32_t vertex : triangle) triangles.add(vertex);
  for (const uint32_t surface : scene.triangle_surface) triangle_surface.add(surface);
  for (const Surface& surface : scene.surfaces) {
    surface_material.add(surface.material);
    surface_object.add(surface.object);
  }
  for (const Edge& edge : scene.edges)
    if (!edge.flat)
      for (const uint32_t vertex : edge.vertices) outlines.add(vertex);
  add("vertices", vertices);
  add("triangles", triangles);
  add("triangle_surface", triangle_surface);
  add("surface_material", surface_material);
  add("surface_object", surface_object);
  add("outlines", outlines);

  Packer wedges, wedge_surface, wedge_shown;
  for (const Wedge& wedge : scene.wedges) {
    wedges.add(wedge.start + from_centre_m);
    wedges.add(wedge.start + wedge.length_m * wedge.along + from_centre_m);
    for (const uint32_t surface : wedge.surface) wedge_surface.add(surface);
    wedge_shown.add(uint8_t{free_edges || wedge.surface[0] != wedge.surface[1]});
  }
  add("wedges", wedges);
  add("wedge_surface", wedge_surface);
  add("wedge_shown", wedge_shown);

  nlohmann::json materials = nlohmann::json::array();
  for (const Material& material : scene.materials) materials.push_back(material.name);
  return {{"prefix", prefix}, {"materials", materials}, {"objects", scene.objects}};
}

nlohmann::json add_vegetation_block(const Scene& scene, const glm::dvec3& from_centre_m, std::string& elements) {
  Packer corners;
  nlohmann::json rows = nlohmann::json::array();
  for (uint32_t material = 0; material < scene.materials.size(); ++material) {
    size_t triangles = 0;
    for (const Volume& volume : scene.volumes) {
      if (volume.material != material) continue;
      for (const auto& triangle : surface_triangles(volume)) {
        for (const glm::dvec3& corner : triangle) corners.add(corner + from_centre_m);
        ++triangles;
      }
    }
    if (triangles > 0) rows.push_back({scene.materials[material].name, triangles});
  }
  if (!rows.empty()) elements += block_element("vegetation", corners);
  return rows;
}

std::vector<glm::dvec3> street_rims(const Street& street) {
  const std::vector<glm::dvec3> line = distinct(street.centre_m);
  std::vector<glm::dvec3> out;
  for (size_t k = 0; line.size() > 1 && k < line.size(); ++k) {
    const glm::dvec3 left(to_rim(line, k, street.width_m / 2), 0);
    out.push_back(line[k] + left);
    out.push_back(line[k] - left);
  }
  return out;
}

std::string add_street_blocks(std::span<const Street> streets, const Scene& scene, const glm::dvec3& centre_m,
                              std::string& elements) {
  glm::dvec2 lower(-std::numeric_limits<double>::infinity()), upper = -lower;
  if (!scene.vertices.empty()) {
    std::swap(lower, upper);
    for (const glm::dvec3& p : scene.vertices) {
      lower = glm::min(lower, flat(scene.origin_m + p) - margin_m);
      upper = glm::max(upper, flat(scene.origin_m + p) + margin_m);
    }
  }
  const auto near = [&](const glm::dvec3& p) {
    return p.x >= lower.x && p.y >= lower.y && p.x <= upper.x && p.y <= upper.y;
  };
  Bands bands;
  size_t left_out = 0;
  for (const Street& street : streets) {
    if (std::ranges::none_of(street.centre_m, near)) continue;
    const std::vector<glm::dvec3> rims = street_rims(street);
    if (bands.count + rims.size() > 2 * most_points)
      ++left_out;
    else
      bands.add(rims, centre_m);
  }
  elements += block_element("street_vertices", bands.vertices) + block_element("street_triangles", bands.triangles);
  if (left_out == 0) return "";
  return fmt::format("the page leaves out {} lanes of the road network, as it holds {} points of them at most",
                     grouped(left_out), grouped(most_points));
}

}  // namespace wavetracer
