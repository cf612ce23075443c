// Polygons with holes into triangles: holes are joined to the outline by bridges, then ears are clipped.
// Exact: the triangles cover the polygon once, use its corners only, and none is flat.
#pragma once
#include "imports/rings.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

// Counter-clockwise triangles of a polygon without a fault(); indices count the corners of the outer ring, then those
// of each hole. Empty where it cannot be done, which would be a fault that fault() does not know. An outline that
// touches itself (crossing_outline) may be given, too; mostly it can be done.
std::vector<Triangle> triangulate(const Polygon& polygon);

}  // namespace wavetracer::imports
