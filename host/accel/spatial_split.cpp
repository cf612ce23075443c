// SPDX-License-Identifier: Apache-2.0
// Splits space (Stich, Friedrich, Dietrich, HPG 2009): a plane cuts the node's box, and triangles that cross it are cut
// too. Boxes of pieces are computed in double and rounded outwards, so that the pieces' boxes always cover the
// triangle.
#include <tbb/parallel_for.h>

#include <array>
#include <cfloat>
#include <cmath>

#include "accel/split.hpp"

namespace wavetracer::accel {
namespace {

constexpr size_t kParallelSpatial = 1024;  // with more references, each axis is searched by its own task
constexpr double kSmallest = 0x1p-149;     // smallest number of float32

// Returns the number of planes to try for a node: it grows with the references, since each plane costs a cut of each
// reference.
int bin_count(size_t references) { return references < 64 ? 8 : kBins; }

// Returns a box around the point where edge ab meets the plane. The pad is one unit in the last place of the larger
// end, more than interpolation in double and rounding to float32 can be off, and never less than the smallest number.
Box crossing(const float (&a)[3], const float (&b)[3], int axis, float plane) {
  const double from = a[axis], t = (static_cast<double>(plane) - from) / (static_cast<double>(b[axis]) - from);
  Box box;
  for (int k = 0; k < 3; k++) {
    const double start = a[k], end = b[k];
    const double x = start + t * (end - start);
    const double pad = static_cast<double>(FLT_EPSILON) * std::max(std::abs(start), std::abs(end)) + kSmallest;
    box.lower[k] = static_cast<float>(x - pad);
    box.upper[k] = static_cast<float>(x + pad);
  }
  return box;
}

// The planes between equal bins of a node's box.
class Planes {
 public:
  Planes(const Box& box, int axis, int bins)
      : lower_(box.lower[axis]), width_(box.extent(axis) / bins), scale_(bins / box.extent(axis)), last_(bins - 1) {}
  float plane(int bin) const { return static_cast<float>(lower_ + width_ * bin); }  // lower side of a bin
  int bin(float x) const { return std::clamp(static_cast<int>((static_cast<double>(x) - lower_) * scale_), 0, last_); }

 private:
  double lower_, width_, scale_;
  int last_;
};

struct Bin {
  Box box;
  size_t enter = 0, leave = 0;  // numbers of references that begin and end in the bin
};

std::array<Bin, kBins> fill_bins(std::span<const AccelTriangle> triangles, std::span<const Reference> references,
                                 const Planes& planes, int axis) {
  std::array<Bin, kBins> bins;
  for (const Reference& reference : references) {
    const int first = planes.bin(reference.box.lower[axis]), last = planes.bin(reference.box.upper[axis]);
    bins[first].enter++;
    bins[last].leave++;
    Box rest = reference.box;
    for (int i = first; i < last; i++) {
      const Pieces pieces = cut(triangles[reference.triangle], rest, axis, planes.plane(i + 1));
      bins[i].box.grow(pieces.left);
      rest = pieces.right;
    }
    bins[last].box.grow(rest);
  }
  return bins;
}

}  // namespace

Pieces cut(const AccelTriangle& triangle, const Box& box, int axis, float plane) {
  Pieces pieces;
  for (int i = 0; i < 3; i++) {
    const auto &a = triangle.v[i], &b = triangle.v[(i + 1) % 3];
    if (a[axis] <= plane) pieces.left.grow(a);
    if (a[axis] >= plane) pieces.right.grow(a);
    if ((a[axis] < plane && b[axis] > plane) || (a[axis] > plane && b[axis] < plane)) {
      const Box point = crossing(a, b, axis, plane);
      pieces.left.grow(point);
      pieces.right.grow(point);
    }
  }
  pieces.left.upper[axis] = std::min(pieces.left.upper[axis], plane);
  pieces.right.lower[axis] = std::max(pieces.right.lower[axis], plane);
  for (Box* piece : {&pieces.left, &pieces.right}) {
    piece->clip(box);
    if (piece->empty()) *piece = Box{};
  }
  return pieces;
}

Split find_spatial_split(std::span<const AccelTriangle> triangles, std::span<const Reference> references,
                         const Box& box, uint32_t block) {
  std::array<Split, 3> best;  // for each axis
  const int bin_limit = bin_count(references.size());
  const auto search = [&](int axis) {
    if (!(box.extent(axis) > 0)) return;
    const std::array<Bin, kBins> bins = fill_bins(triangles, references, Planes(box, axis, bin_limit), axis);
    std::array<Box, kBins> right;  // right[i]: everything from bin i on
    std::array<size_t, kBins> right_count;
    right[bin_limit - 1] = bins[bin_limit - 1].box;
    right_count[bin_limit - 1] = bins[bin_limit - 1].leave;
    for (int i = bin_limit - 2; i > 0; i--) {
      right[i] = right[i + 1];
      right[i].grow(bins[i].box);
      right_count[i] = right_count[i + 1] + bins[i].leave;
    }
    Box left;
    size_t left_count = 0;
    for (int i = 1; i < bin_limit; i++) {
      left.grow(bins[i - 1].box);
      left_count += bins[i - 1].enter;
      if (left_count == 0 || right_count[i] == 0) continue;
      const double cost =
          left.half_area() * test_count(left_count, block) + right[i].half_area() * test_count(right_count[i], block);
      if (cost < best[axis].cost) best[axis] = {cost, axis, i, left, right[i], left_count, right_count[i]};
    }
  };
  if (references.size() >= kParallelSpatial) {
    tbb::parallel_for(0, 3, search);
  } else {
    for (int axis = 0; axis < 3; axis++) search(axis);
  }
  return *std::min_element(best.begin(), best.end(), [](const Split& a, const Split& b) { return a.cost < b.cost; });
}

Halves split_space(std::span<const AccelTriangle> triangles, std::span<const Reference> references, const Box& box,
                   const Split& split) {
  const float plane = Planes(box, split.axis, bin_count(references.size())).plane(split.bin);
  Halves halves;
  Box left = split.left, right = split.right;
  auto left_count = static_cast<double>(split.left_count), right_count = static_cast<double>(split.right_count);
  for (const Reference& reference : references) {
    const Pieces pieces = cut(triangles[reference.triangle], reference.box, split.axis, plane);
    if (pieces.right.empty() || reference.box.upper[split.axis] <= plane) {
      halves.left.push_back(reference);
      continue;
    }
    if (pieces.left.empty() || reference.box.lower[split.axis] >= plane) {
      halves.right.push_back(reference);
      continue;
    }
    // Section 4.4 of the paper: compares the whole reference on one side with a part on both.
    Box whole_left = left, whole_right = right;
    whole_left.grow(reference.box);
    whole_right.grow(reference.box);
    const double both = left.half_area() * left_count + right.half_area() * right_count;
    const double only_left = whole_left.half_area() * left_count + right.half_area() * (right_count - 1);
    const double only_right = left.half_area() * (left_count - 1) + whole_right.half_area() * right_count;
    if (both <= only_left && both <= only_right) {
      halves.left.push_back({pieces.left, reference.triangle});
      halves.right.push_back({pieces.right, reference.triangle});
    } else if (only_left <= only_right) {
      halves.left.push_back(reference);
      left = whole_left;
      right_count--;
    } else {
      halves.right.push_back(reference);
      right = whole_right;
      left_count--;
    }
  }
  return halves;
}

}  // namespace wavetracer::accel
