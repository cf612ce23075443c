// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/curves.cl.
// The curves and their shapes are named here once; curves.cl has functions for each name.
#include "passes/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace wavetracer {

namespace {
struct CurveShape {
  std::string_view name;
  uint32_t dimensions, bits;
};
constexpr CurveShape curve_shapes[] = {
    {"morton2", 2, 32}, {"morton3", 3, 21}, {"morton5", 5, 12}, {"hilbert2", 2, 32}, {"hilbert3", 3, 21}};

const CurveShape& curve_shape_of(const std::string& name) {
  const auto* found = std::find_if(std::begin(curve_shapes), std::end(curve_shapes),
                                   [&](const CurveShape& s) { return s.name == name; });
  if (found != std::end(curve_shapes)) return *found;
  std::string names;
  for (const CurveShape& shape : curve_shapes) names += fmt::format("{}{}", names.empty() ? "" : ", ", shape.name);
  throw std::invalid_argument(fmt::format("curve \"{}\" is not known; there are {}", name, names));
}

uint32_t curve_lanes(const gpu::DeviceInfo& device, uint32_t lanes) {
  if (lanes == 0) return device.cpu ? 16 : 1;
  if (lanes != 1 && lanes != 16) throw std::invalid_argument(fmt::format("curves: {} lanes, not 1 or 16", lanes));
  return lanes;
}

gpu::Definitions curve_definitions(const std::string& name, uint32_t key_bits, uint32_t lanes) {
  return {{"WT_ENCODE", (key_bits == 32 ? "wt_key_" : "wt_encode_") + name},
          {"WT_DECODE", "wt_decode_" + name},
          {"WT_DIMENSIONS", std::to_string(curve_shape_of(name).dimensions)},
          {"WT_KEY_BITS", std::to_string(key_bits)},
          {"WT_LANES", std::to_string(lanes)}};
}

gpu::Range points_range(uint32_t count, uint32_t lanes, uint32_t local) {
  return {(size_t{count} + lanes - 1) / lanes, local};
}
}  // namespace

uint32_t curve_dimensions(const std::string& name) { return curve_shape_of(name).dimensions; }

uint32_t most_curve_bits(const std::string& name, uint32_t key_bits) {
  const CurveShape& shape = curve_shape_of(name);
  return key_bits == 32 ? std::min(shape.bits, 32 / shape.dimensions) : shape.bits;
}

Curve::Curve(gpu::Context& context, const std::string& name, uint32_t lanes)
    : dimensions_(curve_dimensions(name)),
      bits_(most_curve_bits(name, 64)),
      lanes_(curve_lanes(context.info(), lanes)),
      local_(context.info().simple_local_size()) {
  const gpu::Definitions definitions = curve_definitions(name, 64, lanes_);
  encode_ = {context, definitions};
  decode_ = {context, definitions};
}

void Curve::encode(const gpu::Buffer<uint32_t>& points, uint32_t stride, uint32_t count, gpu::Buffer<uint64_t>& codes,
                   uint32_t level) {
  const uint32_t bits = checked(level, points.size(), stride, count, codes.size());
  encode_(points_range(count, lanes_, local_), Stage::order,
          calls::curves::encode{.points = points, .stride = stride, .count = count, .level = bits, .codes = codes});
}

void Curve::decode(const gpu::Buffer<uint64_t>& codes, uint32_t count, gpu::Buffer<uint32_t>& points, uint32_t stride,
                   uint32_t level) {
  const uint32_t bits = checked(level, points.size(), stride, count, codes.size());
  decode_(points_range(count, lanes_, local_), Stage::order,
          calls::curves::decode{.codes = codes, .count = count, .level = bits, .points = points, .stride = stride});
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

PointKeys::PointKeys(gpu::Context& context, const std::string& name, uint32_t key_bits, uint32_t lanes)
    : dimensions_(curve_dimensions(name)),
      bits_(most_curve_bits(name, key_bits)),
      key_bits_(key_bits),
      lanes_(curve_lanes(context.info(), lanes)),
      local_(context.info().simple_local_size()) {
  if (key_bits != 32 && key_bits != 64)
    throw std::invalid_argument(fmt::format("curves: keys of {} bits, not of 32 or 64", key_bits));
  point_keys_ = {context, curve_definitions(name, key_bits, lanes_)};
}

uint32_t PointKeys::level_of(uint64_t cells) { return static_cast<uint32_t>(std::bit_width(cells - 1)); }

device::wt_curve_box PointKeys::cells_of(const CurveBox& box) const {
  if (box.cells < 1 || box.cells > uint64_t{1} << bits_)
    throw std::invalid_argument(fmt::format("curves: {} cells in each of {} dimensions; {} bits hold 1 to 2^{}",
                                            box.cells, dimensions_, key_bits_, bits_));
  if (box.lower.size() != dimensions_ || box.upper.size() != dimensions_)
    throw std::invalid_argument(fmt::format("curves: the corners of the box have {} and {} components, not {}",
                                            box.lower.size(), box.upper.size(), dimensions_));
  device::wt_curve_box cells{};
  cells.cells = static_cast<float>(box.cells);
  cells.last = static_cast<uint32_t>(box.cells - 1);
  for (size_t d = 0; d < dimensions_; ++d) {
    const double extent = double{box.upper[d]} - double{box.lower[d]};
    if (!std::isfinite(extent) || extent < 0)
      throw std::invalid_argument(
          fmt::format("curves: dimension {} of the box goes from {} to {}", d, box.lower[d], box.upper[d]));
    cells.lower[d] = box.lower[d];
    const double scale = extent > 0 ? static_cast<double>(box.cells) / extent : 0;
    cells.scale[d] = scale <= double{std::numeric_limits<float>::max()} ? static_cast<float>(scale) : 0;
  }
  return cells;
}

template <class Key>
void PointKeys::launch(const gpu::Buffer<float>& points, uint32_t stride, uint32_t count, const CurveBox& box,
                       gpu::Buffer<Key>& keys) {
  if (sizeof(Key) * 8 != key_bits_)
    throw std::invalid_argument(
        fmt::format("curves: a buffer of words of {} bits for keys of {} bits", sizeof(Key) * 8, key_bits_));
  if (stride < dimensions_)
    throw std::invalid_argument(fmt::format("curves: points of {} floats each, not of {}", stride, dimensions_));
  const size_t floats = count == 0 ? 0 : size_t{stride} * (count - 1) + dimensions_;
  if (points.size() < floats || keys.size() < count)
    throw std::invalid_argument(
        fmt::format("curves: {} points of {} floats each, but the buffers hold {} floats and {} keys", count, stride,
                    points.size(), keys.size()));
  point_keys_(points_range(count, lanes_, local_), Stage::order,
              calls::curves::point_keys{.points = points,
                                        .stride = stride,
                                        .count = count,
                                        .box = cells_of(box),
                                        .level = level_of(box.cells),
                                        .keys = keys});
}

void PointKeys::operator()(const gpu::Buffer<float>& points, uint32_t stride, uint32_t count, const CurveBox& box,
                           gpu::Buffer<uint32_t>& keys) {
  launch(points, stride, count, box, keys);
}

void PointKeys::operator()(const gpu::Buffer<float>& points, uint32_t stride, uint32_t count, const CurveBox& box,
                           gpu::Buffer<uint64_t>& keys) {
  launch(points, stride, count, box, keys);
}

}  // namespace wavetracer
