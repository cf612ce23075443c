// SPDX-License-Identifier: Apache-2.0
// Makes the lines of a glTF file: paths by their gains, sampled rays by their segments, markers of antennas.
#pragma once
#include <vector>
#include "convert/glb_file.hpp"
#include "convert/vtk_glb_kml.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

// Positions are relative to the origin of the file's root node.
struct GlbLines {
  std::vector<glm::vec3> positions;
  std::vector<GlbFile::Colour> colours;  // one for each position
  std::vector<uint32_t> legs;            // pairs of positions
};

// left_out: increased by the number of paths with points that are not finite.
GlbLines path_lines(const SavedFrame& frame, const GainScale& scale, const glm::dvec3& origin_m, size_t& left_out);
// Draws rays from launch to launch; the first segments are the brightest. Receivers that a ray passes are not points of
// it, and the metre behind a miss is left out.
GlbLines ray_lines(const WaypointRows& rays, const glm::dvec3& origin_m);
// Returns an octahedron of lines with its axes, of radius one metre: it has no triangles, which a ray tracer would take
// for a body.
GlbLines marker_lines(GlbFile::Colour colour);

}  // namespace wavetracer
