// SPDX-License-Identifier: Apache-2.0
// Every side is tried in a fixed order, against all points and the boxes that are taken: there are some dozens.
#include "accuracy/label_places.hpp"
#include <algorithm>

namespace wavetracer::accuracy {
namespace {

constexpr double letter_px = 6.6, line_px = 13, dot_px = 5, gap_px = 7;  // letters of settings are no wider

bool apart(const LabelBox& a, const LabelBox& b) {
  return a.right < b.left || b.right < a.left || a.top < b.bottom || b.top < a.bottom;
}

}  // namespace

LabelBox label_box(const LabelledPoint& point, LabelSide side) {
  const double width = letter_px * static_cast<double>(point.text.size());
  double x = point.x - width / 2, y = point.y - line_px / 2;  // the lower left corner
  if (side == LabelSide::right) x = point.x + gap_px;
  if (side == LabelSide::left) x = point.x - gap_px - width;
  if (side == LabelSide::above) y = point.y + gap_px;
  if (side == LabelSide::below) y = point.y - gap_px - line_px;
  return {.left = x, .bottom = y, .right = x + width, .top = y + line_px};
}

std::vector<LabelSide> label_sides(const std::vector<LabelledPoint>& points, double width, double height) {
  std::vector<LabelBox> dots, taken;
  for (const LabelledPoint& p : points)
    dots.push_back({.left = p.x - dot_px, .bottom = p.y - dot_px, .right = p.x + dot_px, .top = p.y + dot_px});
  std::vector<LabelSide> out;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto free = [&](LabelSide side) {
      const LabelBox box = label_box(points[i], side);
      const auto clear = [&](const LabelBox& other) { return apart(box, other); };
      return box.left >= 0 && box.right <= width && box.bottom >= 0 && box.top <= height &&
             std::ranges::all_of(dots, clear) && std::ranges::all_of(taken, clear);
    };
    out.push_back(LabelSide::none);
    for (const LabelSide side : {LabelSide::right, LabelSide::left, LabelSide::above, LabelSide::below}) {
      if (!free(side)) continue;
      taken.push_back(label_box(points[i], side));
      out.back() = side;
      break;
    }
  }
  return out;
}

}  // namespace wavetracer::accuracy
