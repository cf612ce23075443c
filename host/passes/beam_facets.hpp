// SPDX-License-Identifier: Apache-2.0
// Facets: the triangles of surfaces, put together to convex polygons, because discovery by beams looks at each of them.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "wavetracer/device/beams.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct SurfaceTriangle {
  std::array<glm::dvec3, 3> corners;  // m
  uint32_t surface;
};

struct Facets {
  std::vector<wt_facet> facets;
  std::vector<glm::dvec3> corners;
};

// Facets cover exactly the triangles, and their corners are corners of these. Triangles are put together across the
// longest sides first, while the union is convex, flat to 1e-9 m and has at most WT_FACET_CORNERS corners. Triangles
// without an area are left out. The triangles of a surface must follow each other.
Facets make_facets(std::span<const SurfaceTriangle> triangles);

// The facets of a world whose instances move.
class WorldFacets {
 public:
  WorldFacets(const Scene& scene, const std::vector<Scene>& models);
  // Those of the scene.
  const Facets& fixed() const { return scene_; }
  // Those of the instances that are present, where `placements` says, recentred, and the box of each such instance that
  // has facets. Surfaces have their numbers in the world.
  struct Moving {
    Facets facets;
    std::vector<wt_instance_box> boxes;
  };
  Moving moving(const std::vector<Instance>& instances, std::span<const Placement> placements) const;

 private:
  Facets scene_;
  std::vector<Facets> models_;
};

}  // namespace wavetracer
