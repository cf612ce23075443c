// SPDX-License-Identifier: Apache-2.0
// The public face of the pass OrderKeys, for rays of a queue.
// On CPUs it writes keys in vectors, which may pass the count: these go to memory of its own first.
#include "wavetracer/kernels/order_keys.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kernel_suite/bvh_state.hpp"
#include "passes/order_keys.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* order_keys_name = "OrderKeys";
constexpr size_t lanes = 16;

OrderKey pass_key(RayOrder order) {
  switch (order) {
    case RayOrder::z:
      return OrderKey::morton;
    case RayOrder::hz:
      return OrderKey::morton_bins;
    case RayOrder::h3dh:
    case RayOrder::h3dh2dh:
    case RayOrder::h3dh3dh:
      return OrderKey::hilbert_bins;
    case RayOrder::direction_origin:
      return OrderKey::direction_origin;
  }
  refuse(order_keys_name, "there is no such order");
}

OrderOptions checked_options(const OrderOptions& options) {
  if (!(options.extent >= 0) || !std::isfinite(options.extent))
    refuse(order_keys_name, fmt::format("an extent of {}", options.extent));
  return options;
}

}  // namespace

struct OrderKeys::State : PassState {
  State(const Context& of, RayOrder order, const OrderOptions& options)
      : PassState(of),
        keys(context->gpu, pass_key(order), options.bins, LaunchDirections("hilbert", 1, 0),
             checked_options(options).extent),
        pack(context->gpu, Stage::order) {}
  wavetracer::OrderKeys keys;
  PackRays pack;
  RayQueue queue;                // for rays that are records
  gpu::Buffer<uint32_t> padded;  // for CPUs

  void run(const RayQueue& rays, gpu::Buffer<uint32_t>& out) {
    gpu::Context& gpu = context->gpu;
    if (!gpu.info().cpu) return keys(rays, out);
    if (padded.size() < rays.count + lanes) padded = gpu.buffer<uint32_t>(rays.count + lanes, "keys of rays");
    keys(rays, padded);
    gpu.copy(padded, out, size_t{rays.count} * sizeof(uint32_t), Stage::order);
  }
};

OrderKeys::OrderKeys(const Context& context, RayOrder order, const OrderOptions& options)
    : state_(with_errors([&] { return std::make_unique<State>(context, order, options); })) {}
OrderKeys::~OrderKeys() = default;
OrderKeys::OrderKeys(OrderKeys&&) noexcept = default;
OrderKeys& OrderKeys::operator=(OrderKeys&&) noexcept = default;

unsigned OrderKeys::bits() const { return state_->keys.queue_bits(); }

void OrderKeys::operator()(const Buffer<Ray>& rays, size_t n, const Buffer<uint32_t>& keys, const Call& call) {
  State& s = *state_;
  const uint32_t count = rays_count(order_keys_name, n);
  const gpu::Buffer<wt_packed_ray> from = rays_of(s, order_keys_name, "rays", rays, n);
  gpu::Buffer<uint32_t> to = buffer_of(s, order_keys_name, "keys", keys, n);
  enqueue(s, call, [&] {
    if (s.queue.capacity < padded_capacity(n)) s.queue = make_ray_queue(s.context->gpu, n, "rays in planes");
    s.pack(from, count, s.queue);
    s.run(s.queue, to);
  });
}

void OrderKeys::operator()(const Buffer<float>& planes, size_t capacity, size_t n, const Buffer<uint32_t>& keys,
                           const Call& call) {
  State& s = *state_;
  const uint32_t count = rays_count(order_keys_name, n);
  if (capacity < n || capacity % lanes != 0)
    refuse(order_keys_name,
           fmt::format("{} rays in planes of {}: planes hold all rays and a multiple of {}", n, capacity, lanes));
  const gpu::Buffer<float> from = buffer_of(s, order_keys_name, "planes", planes, 6 * capacity);
  gpu::Buffer<uint32_t> to = buffer_of(s, order_keys_name, "keys", keys, n);
  const RayQueue rays{from, count_of(order_keys_name, capacity), count, 6};
  enqueue(s, call, [&] { s.run(rays, to); });
}

}  // namespace wavetracer::kernels
