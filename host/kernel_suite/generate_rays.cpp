// SPDX-License-Identifier: Apache-2.0
// The public face of the pass GenerateRays.
#include "wavetracer/kernels/generate_rays.hpp"

#include <fmt/format.h>

#include "kernel_suite/bvh_state.hpp"
#include "passes/generate_rays.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* generate_rays_name = "GenerateRays";
constexpr uint64_t most_launched = uint64_t{1} << 31;

Directions pass_directions(LaunchMap map) {
  switch (map) {
    case LaunchMap::hilbert:
      return "hilbert";
    case LaunchMap::horizon:
      return "horizon";
    case LaunchMap::fibonacci:
      return "fibonacci";
    case LaunchMap::random:
      return "random";
  }
  refuse(generate_rays_name, "there is no such map");
}

uint64_t checked_rays(uint64_t rays) {
  if (rays < 1 || rays > most_launched)
    refuse(generate_rays_name, fmt::format("a launch of {} rays: it has 1 to {}", rays, most_launched));
  return rays;
}

}  // namespace

struct GenerateRays::State : PassState {
  State(const Context& of, LaunchMap map, uint64_t rays, uint64_t seed)
      : PassState(of),
        launched(checked_rays(rays)),
        generate(context->gpu, LaunchDirections(pass_directions(map), launched, seed)),
        pack(context->gpu) {}
  uint64_t launched;
  wavetracer::GenerateRays generate;
  PackRays pack;
  RayQueue queue;
};

GenerateRays::GenerateRays(const Context& context, LaunchMap map, uint64_t rays, uint64_t seed)
    : state_(with_errors([&] { return std::make_unique<State>(context, map, rays, seed); })) {}
GenerateRays::~GenerateRays() = default;
GenerateRays::GenerateRays(GenerateRays&&) noexcept = default;
GenerateRays& GenerateRays::operator=(GenerateRays&&) noexcept = default;

void GenerateRays::operator()(const std::array<float, 3>& origin, uint64_t first, size_t n, const Buffer<Ray>& rays,
                              const Call& call) {
  State& s = *state_;
  if (first > s.launched || n > s.launched - first)
    refuse(generate_rays_name, fmt::format("rays {} to {} of a launch of {}", first, first + n, s.launched));
  gpu::Buffer<wt_packed_ray> to = rays_of(s, generate_rays_name, "rays", rays, n);
  enqueue(s, call, [&] {
    if (n == 0) return;
    if (s.queue.capacity < padded_capacity(n)) s.queue = make_ray_queue(s.context->gpu, n, "launched rays");
    s.queue.count = 0;
    s.generate(s.queue, {.transmitter = 0, .position_m = {origin[0], origin[1], origin[2]}}, first,
               static_cast<uint32_t>(n));
    s.pack.unpack(s.queue, to);
  });
}

}  // namespace wavetracer::kernels
