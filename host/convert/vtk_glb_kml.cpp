// SPDX-License-Identifier: Apache-2.0
// Colours are those of matplotlib's plasma map (CC0) without its darkest fifth, which is hard to see on any background.
// A frame must have valid indices of ends and vertices, as SavedRun checks them.
#include "convert/vtk_glb_kml.hpp"

namespace wavetracer {

std::vector<glm::dvec3> path_points(const SavedFrame& frame, size_t path) {
  const Paths& paths = frame.paths;
  std::vector<glm::dvec3> points{frame.transmitter_position_m[paths.tx[path]]};
  for (size_t k = paths.vertex_offset[path]; k < paths.vertex_offset[path + 1]; ++k)
    points.push_back(paths.vertex_position_m[k]);
  points.push_back(frame.receiver_position_m[paths.rx[path]]);
  if (!std::ranges::all_of(points, [](const glm::dvec3& p) { return is_finite(p); })) points.clear();
  return points;
}

Colour gain_colour(double place) {
  static constexpr std::array<Colour, 8> stops{{{0x72, 0x01, 0xa8},
                                                {0x9c, 0x17, 0x9e},
                                                {0xbd, 0x37, 0x86},
                                                {0xd8, 0x57, 0x6b},
                                                {0xed, 0x79, 0x53},
                                                {0xfb, 0x9f, 0x3a},
                                                {0xfd, 0xca, 0x26},
                                                {0xf0, 0xf9, 0x21}}};
  return colour_at(stops, place);
}

}  // namespace wavetracer
