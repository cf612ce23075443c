// Where waves diffract: Scene::wedges from the edges of the mesh.
// Assumes a Scene that is built but for its wedges: surfaces, edges and Edge::flat.
#pragma once
#include "wavetracer/scene.hpp"

namespace wavetracer {

enum class EdgeSearch {
  none,
  of_model,  // all edges that diffract
  of_scene,  // without the rim of the ground (host/scene/ground_rims.hpp)
};

// Fills Scene::wedges and the counts of LoadReport about them; what was there before is replaced. The rule:
//
// 1. Edges that are not flat are cut where they touch or cross one another, within 2 mm. So pieces of meshes that touch
//    without being welded along are one piece, and the faces at a piece are the same all along it.
// 2. The faces at a piece are the half planes that leave it, of whichever mesh: a triangle that ends there gives one,
//    and one that goes through (the ground below a wall) gives two.
// 3. Half planes within 1 mrad are one: walls that touch back to back. One alone is a free edge, a half plane all
//    around which waves go. Otherwise the widest sector between neighbours counts. Wider than 180 degrees and 1 mrad
//    it is a wedge, bounded by two faces; else nothing diffracts: the edge is flat, or it is a corner between three
//    faces or more, as the foot of a wall is. So a concave edge diffracts on its back side only, which paths do not
//    reach if that is inside of a building.
// 4. Pieces in a row, on one line within 2 mm, between the same surfaces, are one wedge.
// 5. Of a scene, free edges at the rim of its ground are left out: the world goes on there.
//
// Wedges are sorted by the vertices of their mesh edges; the same mesh gives the same wedges.
void find_wedges(Scene& scene, EdgeSearch search = EdgeSearch::of_model);

}  // namespace wavetracer
