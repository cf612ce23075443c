// SPDX-License-Identifier: Apache-2.0
// Splits objects by binning (I. Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, IRT 2007), and
// halves. All sums are minima, maxima and integers, so results do not depend on how threads share the work.
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <cstdlib>

#include "accel/split.hpp"

namespace wavetracer::accel {
namespace {

float center(const Reference& reference, int axis) { return static_cast<float>(reference.box.center(axis)); }

// Computes the bin of a centre between the bounds of all centres. Costs and sides use the same function.
struct Binner {
  double lower, scale;
  Binner(const Box& centers, int axis) : lower(centers.lower[axis]), scale(kBins / centers.extent(axis)) {}
  int operator()(float x) const {
    return std::clamp(static_cast<int>((static_cast<double>(x) - lower) * scale), 0, kBins - 1);
  }
};

struct Bin {
  Box box;
  size_t count = 0;
  void add(const Box& other, size_t more) {
    box.grow(other);
    count += more;
  }
};
using Bins = std::array<std::array<Bin, kBins>, 3>;

// Divides the references into tasks if there are enough of them; join must be exactly associative and commutative.
template <class Value, class Add, class Join>
Value reduce(std::span<const Reference> references, const Add& add, const Join& join) {
  if (references.size() <= kParallelReferences) {
    Value value{};
    for (const Reference& reference : references) add(value, reference);
    return value;
  }
  const auto run = [&](const tbb::blocked_range<size_t>& range, Value value) {
    for (size_t i = range.begin(); i < range.end(); i++) add(value, references[i]);
    return value;
  };
  return tbb::parallel_reduce(tbb::blocked_range<size_t>(0, references.size(), kParallelReferences), Value{}, run,
                              join);
}

}  // namespace

Bounds bounds_of(std::span<const Reference> references) {
  return reduce<Bounds>(
      references,
      [](Bounds& bounds, const Reference& reference) {
        bounds.box.grow(reference.box);
        bounds.centers.grow({center(reference, 0), center(reference, 1), center(reference, 2)});
      },
      [](Bounds a, const Bounds& b) {
        a.box.grow(b.box);
        a.centers.grow(b.centers);
        return a;
      });
}

Split find_object_split(std::span<const Reference> references, const Bounds& bounds, uint32_t block) {
  const std::array<Binner, 3> binners{Binner(bounds.centers, 0), Binner(bounds.centers, 1), Binner(bounds.centers, 2)};
  const auto wide = [&](int axis) { return bounds.centers.extent(axis) > 0; };
  const Bins bins = reduce<Bins>(
      references,
      [&](Bins& sums, const Reference& reference) {
        for (int axis = 0; axis < 3; axis++)
          if (wide(axis)) sums[axis][binners[axis](center(reference, axis))].add(reference.box, 1);
      },
      [](Bins a, const Bins& b) {
        for (int axis = 0; axis < 3; axis++)
          for (int i = 0; i < kBins; i++) a[axis][i].add(b[axis][i].box, b[axis][i].count);
        return a;
      });

  const auto imbalance = [](size_t left, size_t right) { return left > right ? left - right : right - left; };
  Split best;
  for (int axis = 0; axis < 3; axis++) {
    if (!wide(axis)) continue;
    std::array<Bin, kBins> right;  // right[i]: everything from bin i on
    right[kBins - 1] = bins[axis][kBins - 1];
    for (int i = kBins - 2; i > 0; i--) {
      right[i] = right[i + 1];
      right[i].add(bins[axis][i].box, bins[axis][i].count);
    }
    Bin left;
    for (int i = 1; i < kBins; i++) {
      left.add(bins[axis][i - 1].box, bins[axis][i - 1].count);
      if (left.count == 0 || right[i].count == 0) continue;
      const double cost = left.box.half_area() * test_count(left.count, block) +
                          right[i].box.half_area() * test_count(right[i].count, block);
      if (cost < best.cost ||
          (cost == best.cost && imbalance(left.count, right[i].count) < imbalance(best.left_count, best.right_count))) {
        best = {cost, axis, i, left.box, right[i].box, left.count, right[i].count};
      }
    }
  }
  return best;
}

Halves split_objects(std::span<const Reference> references, const Box& centers, const Split& split) {
  const Binner binner(centers, split.axis);
  Halves halves;
  halves.left.reserve(split.left_count);
  halves.right.reserve(split.right_count);
  for (const Reference& reference : references)
    (binner(center(reference, split.axis)) < split.bin ? halves.left : halves.right).push_back(reference);
  return halves;
}

Halves split_median(std::span<const Reference> references, const Box& centers) {
  int axis = 0;
  for (int other = 1; other < 3; other++)
    if (centers.extent(other) > centers.extent(axis)) axis = other;
  std::vector<Reference> sorted(references.begin(), references.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Reference& a, const Reference& b) { return center(a, axis) < center(b, axis); });
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() + 1) / 2);
  return {{sorted.begin(), middle}, {middle, sorted.end()}};
}

}  // namespace wavetracer::accel
