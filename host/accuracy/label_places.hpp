// SPDX-License-Identifier: Apache-2.0
// Places for the labels of points, so that no label covers a point or another label.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace wavetracer::accuracy {

// A point of a panel with its text; x and y: pixels from the lower left corner of the panel.
struct LabelledPoint {
  double x = 0, y = 0;
  std::string text;
};

// The side of the point where its text stands.
enum class LabelSide { right, left, above, below, none };

// A box in pixels.
struct LabelBox {
  double left, bottom, right, top;
};

// Returns the box that a label takes on this side of its point, for a sans-serif font of nine points.
LabelBox label_box(const LabelledPoint& point, LabelSide side);

// Returns a side for each point; earlier points choose first, and a point without a free side has none. Boxes lie in a
// panel of this width and height.
std::vector<LabelSide> label_sides(const std::vector<LabelledPoint>& points, double width, double height);

}  // namespace wavetracer::accuracy
