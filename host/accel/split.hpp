// SPDX-License-Identifier: Apache-2.0
// Divides a node's references: finds the best object split and the best spatial split, and carries them out. It is
// internal to the builder; boxes of references must lie inside the node's box.
#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "accel/box.hpp"
#include "accel/triangles.hpp"

namespace wavetracer::accel {

// A triangle, or a part of one, that is being sorted into a leaf.
struct Reference {
  Box box;
  uint32_t triangle = 0;
};

constexpr int kBins = 32;
// One task handles a node with fewer references.
constexpr size_t kParallelReferences = 16384;

// Bounds of boxes and of the boxes' centres.
struct Bounds {
  Box box, centers;
};
Bounds bounds_of(std::span<const Reference> references);

// Returns the number of tests for a leaf of this many triangles, if a test handles `block` triangles at once.
inline double test_count(size_t triangles, uint32_t block) {
  return static_cast<double>((triangles + block - 1) / block);
}

struct Split {
  double cost = std::numeric_limits<double>::infinity();  // half areas of the children times the tests that they need
  int axis = -1;                                          // -1 if there is none
  int bin = 0;                                            // the first bin of the right side
  Box left, right;
  size_t left_count = 0, right_count = 0;
};

// Returns the cheapest way to divide the references by the bin of their centre, over three axes. block is as in
// BuildOptions.
Split find_object_split(std::span<const Reference> references, const Bounds& bounds, uint32_t block);
// Returns the cheapest way to cut the node's box by a plane, over three axes; references on both sides count twice.
Split find_spatial_split(std::span<const AccelTriangle> triangles, std::span<const Reference> references,
                         const Box& box, uint32_t block);

struct Halves {
  std::vector<Reference> left, right;
};
Halves split_objects(std::span<const Reference> references, const Box& centers, const Split& split);
// Halves by count along the widest axis of the centres; for references that no plane separates, and to limit the depth.
Halves split_median(std::span<const Reference> references, const Box& centers);
// Cuts references at the plane, or leaves them whole on the side where that is cheaper ("reference unsplitting").
Halves split_space(std::span<const AccelTriangle> triangles, std::span<const Reference> references, const Box& box,
                   const Split& split);

// The parts of a reference on both sides of a plane; their boxes contain the parts of the triangle in spite of
// rounding.
struct Pieces {
  Box left, right;
};
Pieces cut(const AccelTriangle& triangle, const Box& box, int axis, float plane);

}  // namespace wavetracer::accel
