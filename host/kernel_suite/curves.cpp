// SPDX-License-Identifier: Apache-2.0
// The public face of the pass PointKeys.
#include "wavetracer/kernels/curves.hpp"

#include <fmt/format.h>

#include <array>

#include "kernel_suite/state.hpp"
#include "passes/curves.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* curve_keys_name = "CurveKeys";

std::string pass_curve(Curve curve) {
  constexpr std::array names{"morton2", "morton3", "morton5", "hilbert2", "hilbert3"};
  const auto k = static_cast<size_t>(curve);
  if (k >= names.size()) refuse(curve_keys_name, "there is no such curve");
  return names[k];
}

}  // namespace

struct CurveKeys::State : PassState {
  State(const Context& of, Curve curve, unsigned bits)
      : PassState(of), key_bits(bits), keys(context->gpu, pass_curve(curve), bits) {}
  unsigned key_bits;
  PointKeys keys;

  template <class Key>
  void run(const Buffer<float>& points, size_t n, const CurveBox& box, const Buffer<Key>& out, size_t stride,
           const Call& call) {
    const uint32_t count = count_of(curve_keys_name, n), step = count_of(curve_keys_name, stride);
    const gpu::Buffer<float> from = buffer_of(*this, curve_keys_name, "points", points, 0);
    gpu::Buffer<Key> to = buffer_of(*this, curve_keys_name, "keys", out, n);
    enqueue(*this, call, [&] {
      keys(from, step == 0 ? keys.dimensions() : step, count, {box.lower, box.upper, box.cells}, to);
    });
  }
};

CurveKeys::CurveKeys(const Context& context, Curve curve, unsigned key_bits)
    : state_(with_errors([&] { return std::make_unique<State>(context, curve, key_bits); })) {}
CurveKeys::~CurveKeys() = default;
CurveKeys::CurveKeys(CurveKeys&&) noexcept = default;
CurveKeys& CurveKeys::operator=(CurveKeys&&) noexcept = default;

unsigned CurveKeys::dimensions() const { return state_->keys.dimensions(); }

unsigned CurveKeys::bits(uint64_t cells) const {
  return cells == 0 ? 0 : state_->keys.dimensions() * PointKeys::level_of(cells);
}

void CurveKeys::operator()(const Buffer<float>& points, size_t n, const CurveBox& box, const Buffer<uint32_t>& keys,
                           size_t stride, const Call& call) {
  state_->run(points, n, box, keys, stride, call);
}

void CurveKeys::operator()(const Buffer<float>& points, size_t n, const CurveBox& box, const Buffer<uint64_t>& keys,
                           size_t stride, const Call& call) {
  state_->run(points, n, box, keys, stride, call);
}

}  // namespace wavetracer::kernels
