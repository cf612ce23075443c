// SPDX-License-Identifier: Apache-2.0
// CurveKeys: keys of points along space-filling curves. A sort by them puts near points side by side.
//
//   kernels::CurveKeys keys_of(context, kernels::Curve::hilbert3);
//   keys_of(points, n, {lower, upper, 1024}, keys);
//   sort(keys, order, n, {0, keys_of.bits(1024)});
//
// A key is the code of the cell of a box in which the point lies. x is the lowest bit of each group of bits of a Morton
// code, and the leading bit of each digit of a Hilbert code. Levels nest: a key that is shifted down by the number of
// dimensions is the key in the same box with half as many cells (if cells is a power of two).
//
//   curve      dimensions   the most cells in each dimension, with keys of 32 and of 64 bits
//   morton2    2            2^16, 2^32
//   morton3    3            2^10, 2^21
//   morton5    5            2^6, 2^12
//   hilbert2   2            2^16, 2^32
//   hilbert3   3            2^10, 2^21
#pragma once
#include "wavetracer/kernels/context.hpp"

namespace wavetracer::kernels {

enum class Curve { morton2, morton3, morton5, hilbert2, hilbert3 };

// A box that is cut into `cells` equal parts in each dimension d, from lower[d] to upper[d]. A number of cells that is
// no power of two makes a histogram, whose bins are visited along the curve of the next power.
struct CurveBox {
  std::span<const float> lower, upper;  // an element for each dimension
  uint64_t cells;                       // 1 to the most of the curve
};

// Cost: one launch that moves 4 d bytes and the key for each point. It needs neither double precision nor 64-bit
// atomics. Keys are the same on every device.
class CurveKeys {
 public:
  struct State;  // the suite alone knows it
  // key_bits: 32 or 64. Throws Error for others.
  CurveKeys(const Context& context, Curve curve, unsigned key_bits = 32);
  ~CurveKeys();
  CurveKeys(CurveKeys&&) noexcept;
  CurveKeys& operator=(CurveKeys&&) noexcept;

  // The number of components of a point.
  unsigned dimensions() const;
  // The number of the lowest bits of keys that count in a box of so many cells.
  unsigned bits(uint64_t cells) const;

  // keys[i] becomes the key of point i, for i < n; elements from n on stay. Component d of point i is
  // points[i * stride + d]; a stride of 0 stands for the number of dimensions. n is at most 2^32 - 1.
  // A point on an upper face lies in the last cell. A point outside goes to the nearest cell. NaN goes to cell 0 of its
  // dimension, and so does everything in a dimension where the box has no extent. Cells are told in float32: a point
  // that is nearer to a face between two cells than the rounding of (x - lower) * (cells / extent) may go to either.
  // Throws Error if the box has no extent in float32 (NaN, infinite, upper below lower), too few components or too many
  // cells, if a buffer is too short or of another context, and for keys of other bits than the constructor was given.
  void operator()(const Buffer<float>& points, size_t n, const CurveBox& box, const Buffer<uint32_t>& keys,
                  size_t stride = 0, const Call& call = {});
  void operator()(const Buffer<float>& points, size_t n, const CurveBox& box, const Buffer<uint64_t>& keys,
                  size_t stride = 0, const Call& call = {});

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
