// SPDX-License-Identifier: Apache-2.0
// Ground that follows a raster of heights: a mesh in the coordinates of the scene, and the height at any place.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imports/imports.hpp"
#include "imports/plan.hpp"
#include "scene/georeference.hpp"
#include "scene/ground.hpp"

namespace wavetracer::imports {

struct Terrain {
  std::vector<glm::dvec3> vertices;
  std::vector<Triangle> triangles;  // normals up
  std::optional<Ground> ground;
  ImportSummary::Terrain summary;
  std::vector<std::string> warnings;
};

// Reads options.terrain for the area of the ground. Heights are those of the raster, in metres above its zero. Throws
// InputError for the raster, RuntimeError if GDAL is missing.
Terrain read_terrain(const Extent& area, const Georeference& georeference, const ImportOptions& options);

// Returns the lowest ground along a closed ring, or nothing if the ring reaches beyond the terrain.
std::optional<double> lowest_along(const Ground& ground, std::span<const glm::dvec2> ring);

// Sets Solid::base_m to the lowest ground along the outline of each solid, or of the building that it is a part of.
// Solids that reach beyond the terrain are removed and counted.
void stand_on(const Ground& ground, Plan& plan);

}  // namespace wavetracer::imports
