// SPDX-License-Identifier: Apache-2.0
// The public faces of the pass OrderKeys, for rays and for the indices of a launch.
// On CPUs it writes keys in vectors, which may pass the count: these go to memory of its own first.
#include "wavetracer/kernels/order_keys.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kernel_suite/bvh_state.hpp"
#include "kernel_suite/launch.hpp"
#include "passes/order_keys.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* order_keys_name = "OrderKeys";
constexpr const char* launch_keys_name = "LaunchKeys";
constexpr size_t lanes = 16;

OrderKey pass_key(const char* pass, RayOrder order) {
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
  refuse(pass, "there is no such order");
}

OrderOptions checked_options(const char* pass, const OrderOptions& options) {
  if (!(options.extent >= 0) || !std::isfinite(options.extent))
    refuse(pass, fmt::format("an extent of {}", options.extent));
  return options;
}

// Keys of `count` rays, which write(keys) writes for vectors of rays.
struct WholeVectors {
  gpu::Context& gpu;
  gpu::Buffer<uint32_t> padded;  // for CPUs

  template <class Write>
  void operator()(uint32_t count, gpu::Buffer<uint32_t>& out, const Write& write) {
    if (!gpu.info().cpu) return write(out);
    if (padded.size() < count + lanes) padded = gpu.buffer<uint32_t>(count + lanes, "keys of rays");
    write(padded);
    gpu.copy(padded, out, size_t{count} * sizeof(uint32_t), Stage::order);
  }
};

}  // namespace

struct OrderKeys::State : PassState {
  State(const Context& of, RayOrder order, const OrderOptions& options)
      : PassState(of),
        keys(context->gpu, pass_key(order_keys_name, order), options.bins, LaunchDirections("hilbert", 1, 0),
             checked_options(order_keys_name, options).extent),
        pack(context->gpu, Stage::order),
        whole{context->gpu, {}} {}
  wavetracer::OrderKeys keys;
  PackRays pack;
  RayQueue queue;  // for rays that are records
  WholeVectors whole;

  void run(const RayQueue& rays, gpu::Buffer<uint32_t>& out) {
    whole(rays.count, out, [&](gpu::Buffer<uint32_t>& to) { keys(rays, to); });
  }
};

struct LaunchKeys::State : PassState {
  State(const Context& of, RayOrder order, LaunchMap map, uint64_t rays, uint64_t seed, const OrderOptions& options)
      : PassState(of),
        launched(rays),
        keys(context->gpu, pass_key(launch_keys_name, order), options.bins,
             directions_of(launch_keys_name, map, rays, seed), checked_options(launch_keys_name, options).extent),
        whole{context->gpu, {}} {}
  uint64_t launched;
  wavetracer::OrderKeys keys;
  WholeVectors whole;
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

LaunchKeys::LaunchKeys(const Context& context, RayOrder order, LaunchMap map, uint64_t rays, uint64_t seed,
                       const OrderOptions& options)
    : state_(with_errors([&] { return std::make_unique<State>(context, order, map, rays, seed, options); })) {}
LaunchKeys::~LaunchKeys() = default;
LaunchKeys::LaunchKeys(LaunchKeys&&) noexcept = default;
LaunchKeys& LaunchKeys::operator=(LaunchKeys&&) noexcept = default;

unsigned LaunchKeys::bits() const { return state_->keys.launch_bits(); }

void LaunchKeys::operator()(uint64_t first, size_t n, const Buffer<uint32_t>& keys, const Call& call) {
  State& s = *state_;
  check_launched(launch_keys_name, first, n, s.launched);
  const auto count = static_cast<uint32_t>(n);
  gpu::Buffer<uint32_t> to = buffer_of(s, launch_keys_name, "keys", keys, n);
  enqueue(s, call, [&] {
    if (n > 0) s.whole(count, to, [&](gpu::Buffer<uint32_t>& out) { s.keys(first, count, out); });
  });
}

}  // namespace wavetracer::kernels
