// SPDX-License-Identifier: Apache-2.0
// Host side of curves.cl beside it.
// The curves and their shapes are named here once; curves.cl has a pair of functions for each name.
#include "kernels/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace wavetracer {

namespace {
struct Shape {
  std::string_view name;
  uint32_t dimensions, bits;
};
constexpr Shape shapes[] = {
    {"morton2", 2, 32}, {"morton3", 3, 21}, {"morton5", 5, 12}, {"hilbert2", 2, 32}, {"hilbert3", 3, 21}};

const Shape& shape_of(const std::string& name) {
  const auto* found =
      std::find_if(std::begin(shapes), std::end(shapes), [&](const Shape& s) { return s.name == name; });
  if (found != std::end(shapes)) return *found;
  std::string names;
  for (const Shape& shape : shapes) names += fmt::format("{}{}", names.empty() ? "" : ", ", shape.name);
  throw std::invalid_argument(fmt::format("curve \"{}\" is not known; there are {}", name, names));
}

uint32_t lanes_for(const gpu::DeviceInfo& device) { return device.cpu ? 16 : 1; }
}  // namespace

Curve::Curve(gpu::Context& context, const std::string& name, uint32_t lanes)
    : dimensions_(shape_of(name).dimensions),
      bits_(shape_of(name).bits),
      lanes_(lanes == 0 ? lanes_for(context.info()) : lanes),
      local_(context.info().simple_local_size()) {
  if (lanes_ != 1 && lanes_ != 16) throw std::invalid_argument(fmt::format("curves: {} lanes, not 1 or 16", lanes_));
  const gpu::Definitions definitions{{"WT_ENCODE", "wt_encode_" + name},
                                     {"WT_DECODE", "wt_decode_" + name},
                                     {"WT_DIMENSIONS", std::to_string(dimensions_)},
                                     {"WT_LANES", std::to_string(lanes_)}};
  encode_ = context.kernel("curves", "encode", definitions);
  decode_ = context.kernel("curves", "decode", definitions);
}

void Curve::encode(const gpu::Buffer<uint32_t>& points, uint32_t stride, uint32_t count, gpu::Buffer<uint64_t>& codes,
                   uint32_t level) {
  const uint32_t bits = checked(level, points.size(), stride, count, codes.size());
  encode_(range(count), Stage::transfer, points, stride, count, bits, codes);
}

void Curve::decode(const gpu::Buffer<uint64_t>& codes, uint32_t count, gpu::Buffer<uint32_t>& points, uint32_t stride,
                   uint32_t level) {
  const uint32_t bits = checked(level, points.size(), stride, count, codes.size());
  decode_(range(count), Stage::transfer, codes, count, bits, points, stride);
}

uint32_t Curve::checked(uint32_t level, size_t words, uint32_t stride, uint32_t count, size_t codes) const {
  if (level > bits_)
    throw std::invalid_argument(fmt::format("curves: level {} of a curve of {} bits a component", level, bits_));
  if (stride < count)
    throw std::invalid_argument(fmt::format("curves: {} points in planes of {} words", count, stride));
  if (words < size_t{stride} * (dimensions_ - 1) + count || codes < count)
    throw std::invalid_argument(
        fmt::format("curves: {} points in {} planes of {} words, but the buffers hold {} words and {} codes", count,
                    dimensions_, stride, words, codes));
  return level == 0 ? bits_ : level;
}

gpu::Range Curve::range(uint32_t count) const { return {(size_t{count} + lanes_ - 1) / lanes_, local_}; }

}  // namespace wavetracer
