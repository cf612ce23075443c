// SPDX-License-Identifier: Apache-2.0
// Triangles keep their surface, surfaces their material and object, wedges their faces, so that a click can show them.
// Outlines are the edges that are not flat.
#include "viewer/scene_blocks.hpp"
#include "scene/volume_surface.hpp"
#include "viewer/blocks.hpp"

namespace wavetracer {

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

}  // namespace wavetracer
