// How a node's references are divided: the best object split, the best spatial split, and carrying them out.
// Internal to the builder; assumes references whose boxes lie inside the node's box.
#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "accel/box.hpp"
#include "accel/triangles.hpp"

namespace wavetracer::accel {

// A triangle, or a part of one, on its way into a leaf.
struct Reference {
  Box box;
  uint32_t triangle = 0;
};

constexpr int kBins = 32;
// Nodes of fewer references are handled by one task.
constexpr size_t kParallelReferences = 16384;

// Bounds of boxes and of the boxes' centres.
struct Bounds {
  Box box, centers;
};
Bounds bounds_of(std::span<const Reference> references);

// Tests that a leaf of this many triangles takes, where a test does `block` triangles at once.
inline double test_count(size_t triangles, uint32_t block) {
  return static_cast<double>((triangles + block - 1) / block);
}

struct Split {
  double cost = std::numeric_limits<double>::infinity();  // half areas of the children times the tests they need
  int axis = -1;                                          // -1: there is none
  int bin = 0;                                            // the first bin of the right side
  Box left, right;
  size_t left_count = 0, right_count = 0;
};

// Cheapest way to divide the references by the bin of their centre, over three axes. block as in BuildOptions.
Split find_object_split(std::span<const Reference> references, const Bounds& bounds, uint32_t block);
// Cheapest way to cut the node's box by a plane, over three axes; references on both sides count twice.
Split find_spatial_split(std::span<const AccelTriangle> triangles, std::span<const Reference> references,
                         const Box& box, uint32_t block);

struct Halves {
  std::vector<Reference> left, right;
};
Halves split_objects(std::span<const Reference> references, const Box& centers, const Split& split);
// By count, along the widest axis of the centres; for references that no plane tells apart, and to bound the depth.
Halves split_median(std::span<const Reference> references, const Box& centers);
// Cuts references at the plane, or leaves them whole on the side where that is cheaper ("reference unsplitting").
Halves split_space(std::span<const AccelTriangle> triangles, std::span<const Reference> references, const Box& box,
                   const Split& split);

// The part of a reference on either side of a plane; the boxes hold that part of the triangle whatever rounding does.
struct Pieces {
  Box left, right;
};
Pieces cut(const AccelTriangle& triangle, const Box& box, int axis, float plane);

}  // namespace wavetracer::accel
