// Solids as meshes, and the files of a scene: Mitsuba XML beside meshes/*.ply, as Sionna RT's scenes are.
// Assumes polygons with their triangles, as plan_city() gives them.
#pragma once
#include <filesystem>

#include "imports/plan.hpp"
#include "imports/terrain.hpp"
#include "scene/georeference.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

constexpr double foundation_m = 1;  // what stands on the ground reaches below it, so that no face lies in its plane

struct SceneMesh {
  std::string file;      // without folder and suffix
  std::string name;      // of the object
  std::string material;  // ITU name
  std::vector<glm::dvec3> vertices;
  std::vector<Triangle> triangles;
};

// "way_123 Bäckerei": an id of Mitsuba made of an id of ours and a text of the file.
std::string object_name(const std::string& id, const std::string& text);

// A closed solid, normals outward: one mesh, or two, walls and roof, where their materials differ.
std::vector<SceneMesh> extrude(const Solid& solid);

// The rectangle of the ground: all buildings, the network and the traffic, and the margin; empty without a ground.
Extent ground_extent(const Plan& plan, const ImportOptions& options);

// The ground, flat or that of the terrain; none where the extent is empty.
std::vector<SceneMesh> build_ground(const Extent& extent, const Terrain* terrain, const ImportOptions& options);

// The ground first, if it is asked for, then all solids. Names of meshes are unique.
std::vector<SceneMesh> build_scene(const Plan& plan, const Terrain* terrain, const ImportOptions& options);

// meshes/*.ply in the folder options.output, all at once, then georeference.json, and city.xml last, which names the
// attribution. Throws RuntimeError.
void write_scene(const std::vector<SceneMesh>& meshes, const Georeference& georeference, const ImportOptions& options);

}  // namespace wavetracer::imports
