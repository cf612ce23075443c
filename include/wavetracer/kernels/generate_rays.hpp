// SPDX-License-Identifier: Apache-2.0
// GenerateRays: rays from a point in all directions. The direction of a ray is a pure function of its index in the
// launch (wavetracer/device/directions.h), so any part of a launch may be made, on any device, with the same bits.
//
//   kernels::GenerateRays launch(context, kernels::LaunchMap::fibonacci, 1000000);
//   launch({0, 0, 10}, 0, 1000000, rays);
//
//   hilbert     evenly over the sphere, neighbours in the launch are neighbours in direction
//   horizon     the same order, denser towards the horizon, as a street needs it
//   fibonacci   evenly over the sphere, along a spiral
//   random      at random, by the seed
#pragma once
#include <array>

#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/rays.hpp"

namespace wavetracer::kernels {

enum class LaunchMap { hilbert, horizon, fibonacci, random };

// Cost: two launches, which move 96 bytes for each ray, and 12 more in an order. It needs neither double precision nor
// 64-bit atomics. The object keeps 32 bytes of temporary memory for each ray of the largest call, and 4 for its order.
class GenerateRays {
 public:
  struct State;  // the suite alone knows it
  // rays: those of the whole launch, 1 to 2^31. seed: that of LaunchMap::random. Throws Error for other numbers.
  GenerateRays(const Context& context, LaunchMap map, uint64_t rays, uint64_t seed = 0);
  ~GenerateRays();
  GenerateRays(GenerateRays&&) noexcept;
  GenerateRays& operator=(GenerateRays&&) noexcept;

  // rays[i] becomes ray first + i of the launch from this origin, from t = 0 on without an end, for i < n; elements
  // from n on stay. Directions have unit length, to rounding. first + n is at most the rays of the launch. Throws Error
  // if the buffer is too short or of another context.
  void operator()(const std::array<float, 3>& origin, uint64_t first, size_t n, const Buffer<Ray>& rays,
                  const Call& call = {});
  // The same in an order of the caller's, such as that of LaunchKeys (order_keys.hpp): rays[i] becomes ray
  // first + order[i] of the launch, for i < n. Elements of order are below the rays of the launch minus first; others
  // make rays that are not of the launch.
  void operator()(const std::array<float, 3>& origin, uint64_t first, const Buffer<uint32_t>& order, size_t n,
                  const Buffer<Ray>& rays, const Call& call = {});

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
