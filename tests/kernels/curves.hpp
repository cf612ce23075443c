// SPDX-License-Identifier: Apache-2.0
// curves: points to codes along a space-filling curve and back: morton2, morton3, morton5, hilbert2, hilbert3. Points
// are planes of words: component d of point i is points[d * stride + i]. Elements after the count are not touched.
#pragma once
#include <string>

#include "gpu/gpu.hpp"

namespace wavetracer {

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
  gpu::Kernel encode_, decode_;
  uint32_t dimensions_ = 0, bits_ = 0;
  uint32_t lanes_, local_;
  uint32_t checked(uint32_t level, size_t words, uint32_t stride, uint32_t count, size_t codes) const;
  gpu::Range range(uint32_t count) const;
};

}  // namespace wavetracer
