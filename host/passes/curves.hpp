// SPDX-License-Identifier: Apache-2.0
// curves: points and cells along a space-filling curve: morton2, morton3, morton5, hilbert2, hilbert3. Points are
// floats one after the other; cells are planes of words: component d of cell i is points[d * stride + i]. Elements
// after the count are not touched. No kernel here needs double precision or atomics.
#pragma once
#include <span>
#include <string>

#include "gpu/gpu.hpp"
#include "kernel_calls/curves.hpp"

namespace wavetracer {

// Returns the dimensions of a curve. Throws std::invalid_argument for an unknown name, with a list of all.
uint32_t curve_dimensions(const std::string& name);
// Returns the largest number of bits per component of keys of 32 or 64 bits: at most 32 with two dimensions, 21 with
// three, 12 with five. Throws std::invalid_argument for an unknown name.
uint32_t most_curve_bits(const std::string& name, uint32_t key_bits);

// Codes of cells, and cells of codes.
class Curve {
 public:
  // lanes: points per work-item, 1 or 16; 0 chooses by device, 16 on CPUs and 1 on GPUs.
  // Throws std::invalid_argument for an unknown name, with a list of all, and for other lanes.
  Curve(gpu::Context& context, const std::string& name, uint32_t lanes = 0);

  uint32_t dimensions() const { return dimensions_; }
  // Returns the largest number of bits per component of a 64-bit code: 32, 21 or 12.
  uint32_t bits() const { return bits_; }

  // Components and codes must fit `level` bits per component; 0 means bits(). Morton codes are the same at every level.
  // Throws std::invalid_argument for a level above bits() and for buffers or a stride that do not hold the points.
  void encode(const gpu::Buffer<uint32_t>& points, uint32_t stride, uint32_t count, gpu::Buffer<uint64_t>& codes,
              uint32_t level = 0);
  void decode(const gpu::Buffer<uint64_t>& codes, uint32_t count, gpu::Buffer<uint32_t>& points, uint32_t stride,
              uint32_t level = 0);

 private:
  gpu::KernelOf<calls::curves::encode> encode_;
  gpu::KernelOf<calls::curves::decode> decode_;
  uint32_t dimensions_ = 0, bits_ = 0;
  uint32_t lanes_, local_;
  uint32_t checked(uint32_t level, size_t words, uint32_t stride, uint32_t count, size_t codes) const;
};

// The cells of a box along a curve: `cells` in each dimension, from lower[d] to upper[d]. A number of cells that is no
// power of two makes a histogram, whose bins are visited along the curve of the next power.
struct CurveBox {
  std::span<const float> lower, upper;  // an element for each dimension
  uint64_t cells;                       // 1 .. 2^bits
};

// Keys of points: the codes of the cells of a box in which they lie. A point on an upper face lies in the last cell; a
// point outside goes to the nearest cell; NaN goes to cell 0 of its dimension, and so does everything in a dimension
// where the box has no extent. Cells are told in float32: a point that is nearer to a face between cells than the
// rounding of (component - lower) * cells / extent may go to either of the two.
class PointKeys {
 public:
  // key_bits: 32 or 64. lanes: as above. Throws std::invalid_argument as Curve does, and for other bits of a key.
  PointKeys(gpu::Context& context, const std::string& name, uint32_t key_bits, uint32_t lanes = 0);

  uint32_t dimensions() const { return dimensions_; }
  // Returns the bits that a component of so many cells has: the least level with cells <= 2^level.
  static uint32_t level_of(uint64_t cells);

  // Computes the keys of `count` points, of which the lowest dimensions() * level_of(box.cells) bits count. stride: the
  // floats from a point to the next, at least dimensions().
  // Throws std::invalid_argument for a box that is no box (NaN, infinite, upper below lower), for too many cells, and
  // for buffers that do not hold the points.
  void operator()(const gpu::Buffer<float>& points, uint32_t stride, uint32_t count, const CurveBox& box,
                  gpu::Buffer<uint32_t>& keys);
  void operator()(const gpu::Buffer<float>& points, uint32_t stride, uint32_t count, const CurveBox& box,
                  gpu::Buffer<uint64_t>& keys);

 private:
  gpu::KernelOf<calls::curves::point_keys> point_keys_;
  uint32_t dimensions_ = 0, bits_ = 0, key_bits_ = 0;
  uint32_t lanes_, local_;
  template <class Key>
  void launch(const gpu::Buffer<float>& points, uint32_t stride, uint32_t count, const CurveBox& box,
              gpu::Buffer<Key>& keys);
  device::wt_curve_box cells_of(const CurveBox& box) const;
};

}  // namespace wavetracer
