// SPDX-License-Identifier: Apache-2.0
// OrderKeys: sort keys of rays. Rays that are sorted by them go similar ways one after the other. LaunchKeys: the same
// for the rays of a launch before there are any, from their indices.
//
//   kernels::OrderKeys keys_of(context, kernels::RayOrder::h3dh, {.bins = 16});
//   keys_of(rays, n, keys);
//   sort(keys, order, n, {0, keys_of.bits()});
//
//   kernels::LaunchKeys launch_keys(context, kernels::RayOrder::h3dh, kernels::LaunchMap::random, launched, seed);
//   launch_keys(0, n, keys);
//   sort(keys, order, n, {0, launch_keys.bits()});
//   launch(origin, 0, order, n, rays);                     // GenerateRays, of the same map, launched and seed
//
// The orders are those of A. Zhdanov (TU Munich, 2014, section 6.2.2), by their names there, and one of our own:
//
//   z                  Morton code of the direction, 1,024 cells for each component
//   hz                 histogram of directions, bins^3 cubes around the sphere, visited along a 3D Morton curve
//   h3dh               the same, along a 3D Hilbert curve
//   h3dh2dh, h3dh3dh   keys as of h3dh; the thesis launches the sorted rays over a grid of work-items in two or three
//                      dimensions that follows a Hilbert curve
//   direction_origin   4,096 cells of directions along a Hilbert curve on the octahedron, and in each 16^3 cells of
//   origins; all rays of a launch have one origin, and their keys are 65,536 cells of directions
//
// The sixth order of the thesis, without a sort, needs no keys.
#pragma once
#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/generate_rays.hpp"
#include "wavetracer/kernels/rays.hpp"

namespace wavetracer::kernels {

enum class RayOrder { z, hz, h3dh, h3dh2dh, h3dh3dh, direction_origin };

struct OrderOptions {
  uint32_t bins = 16;  // a histogram has so many for each component of a direction, 1 to 1024
  float extent = 1;  // the largest absolute coordinate of origins, for direction_origin; others go to cells at the rim
};

// Cost: a launch that reads 12 or 24 bytes and writes 4 for each ray; one more, with 64 bytes, for rays that are
// records. It needs neither double precision nor 64-bit atomics. Keys are the same on every device.
class OrderKeys {
 public:
  struct State;  // the suite alone knows it
  // Throws Error for other numbers of bins, and for an extent that is negative or not finite.
  OrderKeys(const Context& context, RayOrder order, const OrderOptions& options = {});
  ~OrderKeys();
  OrderKeys(OrderKeys&&) noexcept;
  OrderKeys& operator=(OrderKeys&&) noexcept;

  // The number of the lowest bits of keys that count: 12 to 30.
  unsigned bits() const;

  // keys[i] becomes the key of rays[i], for i < n; elements from n on stay. Directions have unit length. n is at most
  // 2^31. Throws Error if a buffer is too short or of another context.
  void operator()(const Buffer<Ray>& rays, size_t n, const Buffer<uint32_t>& keys, const Call& call = {});
  // The same for rays that are planes: component k of ray i is planes[k * capacity + i], with the origin's x, y, z as
  // k = 0, 1, 2 and the direction's as 3, 4, 5. capacity is at least n, and a multiple of 16.
  void operator()(const Buffer<float>& planes, size_t capacity, size_t n, const Buffer<uint32_t>& keys,
                  const Call& call = {});

 private:
  std::unique_ptr<State> state_;
};

// Cost: a launch that computes a direction and writes 4 bytes for each ray, and on CPUs a copy of the keys. It needs
// neither double precision nor 64-bit atomics. Keys are the same on every device.
class LaunchKeys {
 public:
  struct State;  // the suite alone knows it
  // map, rays, seed: those of GenerateRays. Throws Error for what it and OrderKeys refuse.
  LaunchKeys(const Context& context, RayOrder order, LaunchMap map, uint64_t rays, uint64_t seed = 0,
             const OrderOptions& options = {});
  ~LaunchKeys();
  LaunchKeys(LaunchKeys&&) noexcept;
  LaunchKeys& operator=(LaunchKeys&&) noexcept;

  // The number of the lowest bits of keys that count: 0 to 30, 16 for direction_origin.
  unsigned bits() const;

  // keys[i] becomes the key of ray first + i of the launch, for i < n; elements from n on stay. first + n is at most
  // the rays of the launch. Throws Error if the buffer is too short or of another context.
  void operator()(uint64_t first, size_t n, const Buffer<uint32_t>& keys, const Call& call = {});

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
