// SPDX-License-Identifier: Apache-2.0
// Embree as the peer: it builds the scene, and traces single rays and packets.
// On x86 it sets FTZ and DAZ, which Embree's manual recommends for speed.
#include "embree_peer.hpp"

#if defined(__SSE3__) || defined(__x86_64__)
#include <pmmintrin.h>
#endif
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <limits>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

constexpr size_t kRaysATask = 2048;  // enough to hide a task's cost, few enough to balance the cores

void flush_denormals() {
#if defined(__SSE3__) || defined(__x86_64__)
  _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ and DAZ
#endif
}

bool has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

template <class Body>
double timed_parallel(size_t count, size_t grain, const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain), [&](const tbb::blocked_range<size_t>& range) {
    flush_denormals();
    body(range.begin(), range.end());
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

RTCIntersectContext make_context(const EmbreeConfig& config) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = config.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

}  // namespace

std::vector<EmbreeConfig> embree_configs() {
  const std::string widest = has_avx512() ? "isa=avx512,frequency_level=simd512" : "isa=avx2";
  std::vector<EmbreeConfig> configs;
  for (const bool robust : {false, true})
    for (const bool high : {false, true}) {
      const std::string suffix = std::string(high ? "-splits" : "") + (robust ? "-robust" : "");
      configs.push_back({"embree1" + suffix, "isa=avx2,tri_accel=bvh8.triangle4", 1, false, robust, high});
      configs.push_back({"embree8" + suffix, widest, 8, true, robust, high});
      configs.push_back({"embree16" + suffix, widest, 16, true, robust, high});
    }
  return configs;
}

EmbreePeer::EmbreePeer(std::span<const AccelTriangle> triangles, EmbreeConfig config)
    : config_(std::move(config)), device_(rtcNewDevice(config_.device.c_str())) {
  if (!device_) {
    throw RuntimeError("Embree refuses the device settings '" + config_.device + "' (error " +
                       std::to_string(rtcGetDeviceError(nullptr)) + ")");
  }
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const size_t count = triangles.size();
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), count));
  for (size_t i = 0; i < count; i++) {
    std::memcpy(vertices + 9 * i, triangles[i].v, sizeof triangles[i].v);
    primitive_.push_back(triangles[i].primitive);
  }
  for (size_t i = 0; i < 3 * count; i++) indices[i] = static_cast<uint32_t>(i);
  rtcSetGeometryBuildQuality(geometry, config_.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(geometry);

  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), config_.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene_.get(), config_.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
    throw RuntimeError("Embree cannot build its tree with '" + config_.device + "' (error " + std::to_string(error) +
                       ")");
  }
}

double EmbreePeer::trace(std::span<const Ray> rays, std::span<Hit> hits) const {
  switch (config_.width) {
    case 1:
      return trace_single(rays, hits);
    case 8:
      return trace_packets<8, RTCRayHit8, rtcIntersect8>(rays, hits);
    case 16:
      return trace_packets<16, RTCRayHit16, rtcIntersect16>(rays, hits);
    default:
      throw RuntimeError("Embree traces 1, 8 or 16 rays a call, not " + std::to_string(config_.width));
  }
}

double EmbreePeer::trace_single(std::span<const Ray> rays, std::span<Hit> hits) const {
  return timed_parallel(rays.size(), kRaysATask, [&](size_t begin, size_t end) {
    RTCIntersectContext context = make_context(config_);
    for (size_t i = begin; i < end; i++) {
      const Ray& ray = rays[i];
      RTCRayHit query;
      query.ray = {ray.origin[0],
                   ray.origin[1],
                   ray.origin[2],
                   ray.t_min,
                   ray.direction[0],
                   ray.direction[1],
                   ray.direction[2],
                   0,
                   ray.t_max,
                   ~0u,
                   0,
                   0};
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_.get(), &context, &query);
      hits[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? Hit{ray.t_max, kNoPrimitive}
                                                            : Hit{query.ray.tfar, primitive_[query.hit.primID]};
    }
  });
}

template <unsigned Width, class Packet, auto Intersect>
double EmbreePeer::trace_packets(std::span<const Ray> rays, std::span<Hit> hits) const {
  using Lanes = std::array<float, Width>;
  struct alignas(64) Block {
    std::array<Lanes, 3> origin, direction;
    Lanes t_min, t_max;
  };
  std::vector<Block> blocks((rays.size() + Width - 1) / Width);
  for (size_t i = 0; i < blocks.size() * Width; i++) {
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    Block& block = blocks[i / Width];
    for (size_t axis = 0; axis < 3; axis++) {
      block.origin[axis][i % Width] = ray.origin[axis];
      block.direction[axis][i % Width] = ray.direction[axis];
    }
    block.t_min[i % Width] = ray.t_min;
    block.t_max[i % Width] = ray.t_max;
  }
  return timed_parallel(blocks.size(), kRaysATask / Width, [&](size_t begin, size_t end) {
    RTCIntersectContext context = make_context(config_);
    alignas(64) std::array<int, Width> valid;
    for (size_t b = begin; b < end; b++) {
      const Block& block = blocks[b];
      const size_t first = b * Width, count = std::min<size_t>(Width, rays.size() - first);
      for (size_t i = 0; i < Width; i++) valid[i] = i < count ? -1 : 0;
      alignas(64) Packet packet;
      const auto copy = [](auto& to, const Lanes& from) { std::memcpy(to, from.data(), sizeof from); };
      copy(packet.ray.org_x, block.origin[0]);
      copy(packet.ray.org_y, block.origin[1]);
      copy(packet.ray.org_z, block.origin[2]);
      copy(packet.ray.dir_x, block.direction[0]);
      copy(packet.ray.dir_y, block.direction[1]);
      copy(packet.ray.dir_z, block.direction[2]);
      copy(packet.ray.tnear, block.t_min);
      copy(packet.ray.tfar, block.t_max);
      std::memset(packet.ray.time, 0, sizeof packet.ray.time);
      std::memset(packet.ray.mask, 0xff, sizeof packet.ray.mask);
      std::memset(packet.ray.flags, 0, sizeof packet.ray.flags);
      std::memset(packet.hit.geomID, 0xff, sizeof packet.hit.geomID);
      std::memset(packet.hit.instID, 0xff, sizeof packet.hit.instID);
      Intersect(valid.data(), scene_.get(), &context, &packet);
      for (size_t i = 0; i < count; i++) {
        hits[first + i] = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                              ? Hit{block.t_max[i], kNoPrimitive}
                              : Hit{packet.ray.tfar[i], primitive_[packet.hit.primID[i]]};
      }
    }
  });
}

}  // namespace wavetracer::bench
