// SPDX-License-Identifier: Apache-2.0
// The public face of the pass GenerateRays.
#include "wavetracer/kernels/generate_rays.hpp"

#include "kernel_suite/bvh_state.hpp"
#include "kernel_suite/launch.hpp"
#include "passes/generate_rays.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* generate_rays_name = "GenerateRays";

}  // namespace

struct GenerateRays::State : PassState {
  State(const Context& of, LaunchMap map, uint64_t rays, uint64_t seed)
      : PassState(of),
        launched(rays),
        generate(context->gpu, directions_of(generate_rays_name, map, rays, seed)),
        pack(context->gpu) {}
  uint64_t launched;
  wavetracer::GenerateRays generate;
  PackRays pack;
  RayQueue queue;
  gpu::Buffer<uint32_t> order;  // a copy of a given order, with the further elements that the pass reads

  void reserve(size_t n) {
    if (queue.capacity < padded_capacity(n)) queue = make_ray_queue(context->gpu, n, "launched rays");
    queue.count = 0;
  }
};

GenerateRays::GenerateRays(const Context& context, LaunchMap map, uint64_t rays, uint64_t seed)
    : state_(with_errors([&] { return std::make_unique<State>(context, map, rays, seed); })) {}
GenerateRays::~GenerateRays() = default;
GenerateRays::GenerateRays(GenerateRays&&) noexcept = default;
GenerateRays& GenerateRays::operator=(GenerateRays&&) noexcept = default;

void GenerateRays::operator()(const std::array<float, 3>& origin, uint64_t first, size_t n, const Buffer<Ray>& rays,
                              const Call& call) {
  State& s = *state_;
  check_launched(generate_rays_name, first, n, s.launched);
  gpu::Buffer<wt_packed_ray> to = rays_of(s, generate_rays_name, "rays", rays, n);
  enqueue(s, call, [&] {
    if (n == 0) return;
    s.reserve(n);
    s.generate(s.queue, {.transmitter = 0, .position_m = {origin[0], origin[1], origin[2]}}, first,
               static_cast<uint32_t>(n));
    s.pack.unpack(s.queue, to);
  });
}

void GenerateRays::operator()(const std::array<float, 3>& origin, uint64_t first, const Buffer<uint32_t>& order,
                              size_t n, const Buffer<Ray>& rays, const Call& call) {
  State& s = *state_;
  check_launched(generate_rays_name, first, n, s.launched);
  const gpu::Buffer<uint32_t> given = buffer_of(s, generate_rays_name, "order", order, n);
  gpu::Buffer<wt_packed_ray> to = rays_of(s, generate_rays_name, "rays", rays, n);
  enqueue(s, call, [&] {
    if (n == 0) return;
    s.reserve(n);
    if (s.order.size() < s.queue.capacity) s.order = s.context->gpu.buffer<uint32_t>(s.queue.capacity, "launch order");
    s.context->gpu.copy(given, s.order, n * sizeof(uint32_t), Stage::generate_rays);
    s.generate(s.queue, {.transmitter = 0, .position_m = {origin[0], origin[1], origin[2]}}, first,
               static_cast<uint32_t>(n), s.order);
    s.pack.unpack(s.queue, to);
  });
}

}  // namespace wavetracer::kernels
