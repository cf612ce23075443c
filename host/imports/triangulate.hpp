// SPDX-License-Identifier: Apache-2.0
// Triangulates polygons with holes: holes are joined to the outline by bridges, then ears are clipped.
// It is exact: the triangles cover the polygon once, use only its corners, and none is flat.
#pragma once
#include "imports/rings.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

// Returns counter-clockwise triangles of a polygon without a fault(); indices count the corners of the outer ring, then
// those of each hole. It returns nothing if that is impossible, which would be a fault that fault() does not detect. An
// outline that touches itself (crossing_outline) may be given, too, and mostly works.
std::vector<Triangle> triangulate(const Polygon& polygon);

}  // namespace wavetracer::imports
