// SPDX-License-Identifier: Apache-2.0
// Finds where waves diffract: fills Scene::wedges from the edges of the mesh.
// The Scene must be complete except for its wedges: surfaces, edges and Edge::flat.
#pragma once
#include "wavetracer/scene.hpp"

namespace wavetracer {

enum class EdgeSearch {
  none,
  of_model,  // all edges that diffract
  of_scene,  // all but the rim of the ground (host/scene/ground_sheets.hpp)
};

// Fills Scene::wedges and the counts of LoadReport about them; what was there before is replaced. The rule:
//
// 1. Edges that are not flat are cut where they touch or cross one another, within 2 mm. So edges of meshes that touch
//   without being welded become one piece, and the faces at a piece are the same all along it.
// 2. The faces at a piece are the half planes that start at it, of any mesh: a triangle that ends there gives one,
//   and one that goes through (the ground below a wall) gives two.
// 3. Half planes within 1 mrad of each other are one wall: nothing is between them, and each bounds its own side. One
//   wall alone is a free edge, a half plane all around which waves go. Every sector between neighbouring walls is a
//   wedge: convex if it is wider than 180 degrees, else a corner, and both sides of a bend are one each. Two
//   angles are left out: 180 degrees, to 1e-9 rad, where nothing is bent; and 90 degrees, to 3e-6 rad (upright walls of
//   float32), where the images of both faces are complete and the wave of the edge vanishes. So rooms, and walls on a
//   flat ground, have no corners.
// 4. Pieces in a row, on one line within 2 mm, between the same surfaces, are one wedge.
// 5. In a scene, free edges at the rim of the ground are left out, since the world continues there.
//
// Convex wedges come first, then corners, both sorted by the vertices of their mesh edges; the same mesh gives the same
// wedges.
void find_wedges(Scene& scene, EdgeSearch search = EdgeSearch::of_model);

}  // namespace wavetracer
