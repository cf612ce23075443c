// SPDX-License-Identifier: Apache-2.0
// Bvh: a tree over triangles, and the rays that are traced through it.
//
//   kernels::Bvh bvh(context, corners);
//   bvh.nearest(rays, n, hits);
//
// The test of triangles is watertight, both of their sides are met, and where two are met at the same t the lower
// number counts. So t and triangle of a hit have the same bits on every device and with every option.
#pragma once
#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/rays.hpp"

namespace wavetracer::kernels {

struct BvhOptions {
  // Triangles may be cut where boxes would overlap much. That helps where large triangles are not parallel to the axes,
  // and may cost time elsewhere. Hits stay the same.
  bool spatial_splits = false;
  // The largest absolute coordinate of any origin of a ray: boxes are padded for the rounding of such distances. A
  // value that is smaller than the triangles' own coordinates changes nothing.
  float reach = 0;
};

// Cost. The host builds the tree, on all cores; the device keeps some 300 bytes for each triangle, on CPUs some 600.
// GPUs trace a ray in each work-item through a binary tree; CPUs test eight boxes and four triangles of an eight-wide
// tree at a time. It needs double precision, which decides about rays through edges.
class Bvh {
 public:
  struct State;  // the suite alone knows it
  // corners: nine floats for each triangle; triangle i begins at corners[9 * i]. There may be none, and at most 2^27.
  // Triangles without area are never met. Throws Error for a number of floats that is no multiple of nine, for NaN and
  // infinite coordinates, and if the device has too little memory or no double precision.
  Bvh(const Context& context, std::span<const float> corners, const BvhOptions& options = {});
  // vertices: three floats each. indices: three vertices for each triangle. Throws Error as above, and for the index of
  // a vertex that is not there.
  Bvh(const Context& context, std::span<const float> vertices, std::span<const uint32_t> indices,
      const BvhOptions& options = {});
  ~Bvh();
  Bvh(Bvh&&) noexcept;
  Bvh& operator=(Bvh&&) noexcept;

  size_t triangles() const;

  // hits[i] becomes the nearest hit of rays[i], for i < n; elements from n on stay. n is at most 2^32 - 1. Throws Error
  // if a buffer is too short or of another context; so do the others.
  void nearest(const Buffer<Ray>& rays, size_t n, const Buffer<Hit>& hits, const Call& call = {});
  // met[i] becomes 1 where rays[i] meets any triangle, else 0. A traversal ends at its first hit.
  void any(const Buffer<Ray>& rays, size_t n, const Buffer<uint32_t>& met, const Call& call = {});
  // Does the same as nearest() on CPUs, for rays whose neighbours in the list go similar ways: packets of 16 of them
  // are traced together. Rays begin at t = 0 and have no end, whatever their t_min and t_max, and u and v of hits are
  // 0. It needs 48 bytes of temporary memory for each ray, which the object keeps; n is at most 2^31. Throws Error on
  // other devices than CPUs.
  void nearest_in_packets(const Buffer<Ray>& rays, size_t n, const Buffer<Hit>& hits, const Call& call = {});

  State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
