// Sheets: sets of surfaces that touch along edges, such as a ground of many triangles. Up is z.
#pragma once
#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

class SurfaceSheets {
 public:
  // Joins surfaces that share edges of the mesh, flat ones alone (is_flat) where that is asked for. scene outlives
  // this.
  explicit SurfaceSheets(const Scene& scene, bool flat_alone = false);
  void join(uint32_t surface, uint32_t other) { sheets_.join(surface, other); }
  // The surface that stands for the sheet of this one.
  uint32_t root(uint32_t surface) { return sheets_.root(surface); }
  // Of each surface that stands for a sheet: does the sheet span at least half of the scene, seen from above (half of
  // the area of the box around it)?
  std::vector<bool> wide();

 private:
  const Scene& scene_;
  Forest sheets_;  // of surfaces
};

// Is the surface flatter than 45 degrees?
bool is_flat(const Surface& surface);

// How many surfaces the ground of a scene has: those of the largest sheet of surfaces flatter than 45 degrees that
// spans half of it. 1 on a flat ground, thousands on a terrain, 0 where there is none. Assumes scene.edges.
size_t ground_surfaces(const Scene& scene);

}  // namespace wavetracer
