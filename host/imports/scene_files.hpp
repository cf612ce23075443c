// SPDX-License-Identifier: Apache-2.0
// Turns solids into meshes, and writes the files of a scene: Mitsuba XML and meshes/*.ply, as in Sionna RT's scenes.
// Polygons must have their triangles, as plan_city() returns them.
#pragma once
#include <filesystem>

#include "imports/plan.hpp"
#include "imports/terrain.hpp"
#include "scene/georeference.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

constexpr double foundation_m = 1;  // solids on the ground reach this far below it, so that no face lies in its plane

struct SceneMesh {
  std::string file;      // without folder and suffix
  std::string name;      // name of the object
  std::string material;  // ITU name, or a wall class
  std::vector<glm::dvec3> vertices;
  std::vector<Triangle> triangles;
};

// Returns a name such as "way_123 Bäckerei": an id of Mitsuba made of our id and a text of the file.
std::string object_name(const std::string& id, const std::string& text);

// Returns a closed solid with normals outward: one mesh, or two for walls and roof if their materials differ.
std::vector<SceneMesh> extrude(const Solid& solid);

// Returns the rectangle of the ground: all buildings, the network, the traffic and the margin; empty if no ground is
// wanted.
Extent ground_extent(const Plan& plan, const ImportOptions& options);

// Returns the ground, flat or following the terrain; none if the extent is empty.
std::vector<SceneMesh> build_ground(const Extent& extent, const Terrain* terrain, const ImportOptions& options);

// Returns the ground first, if it is wanted, then all solids. Names of meshes are unique.
std::vector<SceneMesh> build_scene(const Plan& plan, const Terrain* terrain, const ImportOptions& options);

// Writes meshes/*.ply in the folder options.output, all at once, then georeference.json, and last city.xml, which
// contains the attribution. Throws RuntimeError.
void write_scene(const std::vector<SceneMesh>& meshes, const Georeference& georeference, const ImportOptions& options);

}  // namespace wavetracer::imports
