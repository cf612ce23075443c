// SPDX-License-Identifier: Apache-2.0
// The public face of the trees and the passes TraceRays and Trace.
// Each triangle is a surface of its own.
#include "wavetracer/kernels/bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel_suite/bvh_state.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* bvh_name = "Bvh";
constexpr size_t most_triangles = size_t{1} << 27;  // leaves have 28 bits for a place (wavetracer/device/bvh.h)

std::vector<AccelTriangle> triangles_of(std::span<const float> corners) {
  if (corners.size() % 9 != 0)
    refuse(bvh_name, fmt::format("{} floats are no triangles of nine floats each", corners.size()));
  if (corners.size() / 9 > most_triangles)
    refuse(bvh_name, fmt::format("{} triangles: at most {}", corners.size() / 9, most_triangles));
  std::vector<AccelTriangle> triangles(corners.size() / 9);
  for (size_t i = 0; i < triangles.size(); ++i) {
    for (size_t k = 0; k < 9; ++k) {
      const float coordinate = corners[9 * i + k] + 0.0f;  // without negative zeros, see accel/triangles.hpp
      if (!std::isfinite(coordinate)) refuse(bvh_name, fmt::format("triangle {} has the coordinate {}", i, coordinate));
      triangles[i].v[k / 3][k % 3] = coordinate;
    }
    triangles[i].primitive = triangles[i].surface = static_cast<uint32_t>(i);
  }
  return triangles;
}

float extent_of(std::span<const float> corners, float reach) {
  if (!(reach >= 0) || !std::isfinite(reach)) refuse(bvh_name, fmt::format("a reach of {}", reach));
  for (const float x : corners) reach = std::max(reach, std::abs(x));
  return reach;
}

std::vector<float> corners_of(std::span<const float> vertices, std::span<const uint32_t> indices) {
  if (vertices.size() % 3 != 0 || indices.size() % 3 != 0)
    refuse(bvh_name,
           fmt::format("{} coordinates and {} indices: both are multiples of three", vertices.size(), indices.size()));
  std::vector<float> corners;
  corners.reserve(3 * indices.size());
  for (const uint32_t index : indices) {
    if (index >= vertices.size() / 3)
      refuse(bvh_name, fmt::format("vertex {} of {} vertices", index, vertices.size() / 3));
    const auto vertex = vertices.subspan(size_t{3} * index, 3);
    corners.insert(corners.end(), vertex.begin(), vertex.end());
  }
  return corners;
}

}  // namespace

Bvh::State::State(const Context& of, std::span<const float> given, const BvhOptions& options)
    : PassState(of),
      trees(make_device_trees(context->gpu, triangles_of(given), options.spatial_splits,
                              extent_of(given, options.reach))),
      corners(context->gpu.buffer(std::vector<float>(given.begin(), given.end()), "corners of triangles")),
      trace(context->gpu, trees) {}

Bvh::Bvh(const Context& context, std::span<const float> corners, const BvhOptions& options)
    : state_(with_errors([&] {
        require_device(context, bvh_name, {.fp64 = true, .int64_atomics = false});
        return std::make_unique<State>(context, corners, options);
      })) {}
Bvh::Bvh(const Context& context, std::span<const float> vertices, std::span<const uint32_t> indices,
         const BvhOptions& options)
    : Bvh(context, corners_of(vertices, indices), options) {}
Bvh::~Bvh() = default;
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;

size_t Bvh::triangles() const { return state_->trees.primitive_count; }

void Bvh::nearest(const Buffer<Ray>& rays, size_t n, const Buffer<Hit>& hits, const Call& call) {
  State& s = *state_;
  const uint32_t count = count_of(bvh_name, n);
  const gpu::Buffer<wt_packed_ray> from = rays_of(s, bvh_name, "rays", rays, n);
  gpu::Buffer<wt_packed_hit> to = hits_of(s, bvh_name, "hits", hits, n);
  enqueue(s, call, [&] { s.trace.nearest(s.trees, s.corners, from, count, to); });
}

void Bvh::any(const Buffer<Ray>& rays, size_t n, const Buffer<uint32_t>& met, const Call& call) {
  State& s = *state_;
  const uint32_t count = count_of(bvh_name, n);
  const gpu::Buffer<wt_packed_ray> from = rays_of(s, bvh_name, "rays", rays, n);
  gpu::Buffer<uint32_t> to = buffer_of(s, bvh_name, "met", met, n);
  enqueue(s, call, [&] { s.trace.any(s.trees, from, count, to); });
}

void Bvh::nearest_in_packets(const Buffer<Ray>& rays, size_t n, const Buffer<Hit>& hits, const Call& call) {
  State& s = *state_;
  if (!s.trees.cpu) refuse(bvh_name, "packets of rays are for CPUs: call nearest() on this device");
  const uint32_t count = rays_count(bvh_name, n);
  const gpu::Buffer<wt_packed_ray> from = rays_of(s, bvh_name, "rays", rays, n);
  gpu::Buffer<wt_packed_hit> to = hits_of(s, bvh_name, "hits", hits, n);
  with_errors([&] {
    if (!s.packets) s.packets.emplace(s.context->gpu, s.trees);
    if (s.packets->queue.capacity < padded_capacity(n)) {
      s.packets->queue = make_ray_queue(s.context->gpu, n, "packets of rays");
      s.packets->hits = make_hit_list(s.context->gpu, n);
    }
  });
  enqueue(s, call, [&] {
    s.packets->pack(from, count, s.packets->queue);
    s.packets->trace(s.trees, s.packets->queue, s.packets->hits);
    s.packets->pack.unpack(s.packets->hits, count, to);
  });
}

}  // namespace wavetracer::kernels
