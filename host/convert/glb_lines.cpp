// SPDX-License-Identifier: Apache-2.0
// Colours belong to vertices and are linear, as glTF requires.
// If a line continues, both legs use the same position, so that lines share their corners.
#include "convert/glb_lines.hpp"
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace wavetracer {
namespace {

uint8_t linear_byte(uint8_t srgb) {
  const double s = srgb / 255.0;
  return static_cast<uint8_t>(std::lround(255 * (s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4))));
}

GlbFile::Colour linear(const Colour& srgb) {
  return {linear_byte(srgb[0]), linear_byte(srgb[1]), linear_byte(srgb[2]), 255};
}

void add_point(GlbLines& lines, const glm::dvec3& position_m, GlbFile::Colour colour, bool from_the_last) {
  if (from_the_last)
    for (const size_t end : {lines.positions.size() - 1, lines.positions.size()})
      lines.legs.push_back(static_cast<uint32_t>(end));
  lines.positions.emplace_back(position_m);
  lines.colours.push_back(colour);
}

}  // namespace

GlbLines path_lines(const SavedFrame& frame, const GainScale& scale, const glm::dvec3& origin_m, size_t& left_out) {
  GlbLines out;
  for (size_t i = 0; i < frame.paths.size(); ++i) {
    const std::vector<glm::dvec3> points = path_points(frame, i);
    if (points.empty()) ++left_out;
    const GlbFile::Colour colour = linear(gain_colour(scale.place(frame.paths.gain_db[i])));
    for (size_t k = 0; k < points.size(); ++k) add_point(out, points[k] - origin_m, colour, k > 0);
  }
  return out;
}

GlbLines ray_lines(const WaypointRows& rays, const glm::dvec3& origin_m) {
  GlbLines out;
  const uint32_t deepest = rays.depth.empty() ? 0 : std::ranges::max(rays.depth);
  std::optional<size_t> launch;  // the row of a launch from which no segment was drawn yet
  const auto add = [&](size_t row, bool from_the_last) {
    const double place = 1 - static_cast<double>(std::max(rays.depth[row], 1u) - 1) / std::max(deepest, 1u);
    add_point(out, rays.position_m[row] - origin_m, linear(gain_colour(place)), from_the_last);
  };
  for (size_t i = 0; i < rays.size(); ++i) {
    if (rays.kind[i] == WaypointKind::hit || rays.kind[i] == WaypointKind::miss) continue;
    if (rays.kind[i] == WaypointKind::launch) {
      launch = i;
      continue;
    }
    if (launch) add(*std::exchange(launch, std::nullopt), false);
    add(i, true);
  }
  return out;
}

GlbLines marker_lines(GlbFile::Colour colour) {
  GlbLines out{.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
               .colours = {},
               .legs = {0, 1, 1, 2, 2, 3, 3, 0, 4, 0, 4, 1, 4, 2, 4, 3, 5, 0, 5, 1, 5, 2, 5, 3, 0, 2, 1, 3, 4, 5}};
  out.colours.assign(out.positions.size(), colour);
  return out;
}

}  // namespace wavetracer
