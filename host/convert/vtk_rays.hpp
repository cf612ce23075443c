// SPDX-License-Identifier: Apache-2.0
// Writes the sampled rays of a frame (waypoints.h5) as a file for ParaView.
#pragma once
#include "convert/vtk_file.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

// Returns one polyline per ray, from its launch to its last point. Arrays on lines: `tx` and `sample`; on points:
// `depth`, `kind` and `source` (numbers of WaypointKind and WaypointSource), `surface` and `vehicle`, -1 where there is
// none. Receivers that a ray passes are not among its points.
VtkFile rays_file(const WaypointRows& rows);

}  // namespace wavetracer
