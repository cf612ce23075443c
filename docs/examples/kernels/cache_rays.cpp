// SPDX-License-Identifier: Apache-2.0
// A ray cache in a tracer of your own, which traces spheres by a kernel of its own: cache_rays [DEVICE [RAYS]]
// DEVICE is the index of an OpenCL device, counted over all platforms (default 0); RAYS is how many a frame has
// (default 20000). From frame to frame a tenth of the rays is new; the cache answers the others.
#include <cmath>
#include <cstdint>
#include <random>

#include "opencl_user.hpp"
#include "wavetracer/kernels/ray_cache.hpp"

namespace {

using wavetracer::kernels::Hit;
using wavetracer::kernels::Ray;

// The records are those of wavetracer/device/packed_rays.h. Spheres of radius 1 are at (4 k, 0, 0), for k = 0 .. 7.
constexpr const char* source = R"(
typedef struct { float origin[3], t_min, direction[3], t_max; } Ray;
typedef struct { float t; uint triangle; float u, v; } Hit;
kernel void trace_spheres(global const Ray* rays, global Hit* hits, uint count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const float3 o = vload3(0, rays[i].origin), d = vload3(0, rays[i].direction);
  Hit hit = {INFINITY, 0xFFFFFFFFu, 0.0f, 0.0f};
  for (uint k = 0; k < 8; ++k) {
    const float3 from = o - (float3)(4.0f * k, 0.0f, 0.0f);
    const float b = dot(from, d), c = dot(from, from) - 1.0f, root = b * b - c;
    const float t = -b - sqrt(fmax(root, 0.0f));
    if (root < 0.0f || t <= 0.0f || t >= hit.t) continue;
    hit.t = t;
    hit.triangle = k;
  }
  hits[i] = hit;
})";

class SphereTracer {
 public:
  explicit SphereTracer(const OpenClUser& user) : queue_(user.queue) {
    cl_int code = CL_SUCCESS;
    const char* text = source;
    program_ = clCreateProgramWithSource(user.context, 1, &text, nullptr, &code);
    check(code, "clCreateProgramWithSource");
    check(clBuildProgram(program_, 1, &user.device, "", nullptr, nullptr), "clBuildProgram");
    kernel_ = clCreateKernel(program_, "trace_spheres", &code);
    check(code, "clCreateKernel");
  }
  ~SphereTracer() {
    clReleaseKernel(kernel_);
    clReleaseProgram(program_);
  }
  SphereTracer(const SphereTracer&) = delete;
  SphereTracer& operator=(const SphereTracer&) = delete;

  void operator()(cl_mem rays, cl_mem hits, size_t count) {
    if (count == 0) return;
    const auto number = static_cast<cl_uint>(count);
    check(clSetKernelArg(kernel_, 0, sizeof rays, &rays), "clSetKernelArg");
    check(clSetKernelArg(kernel_, 1, sizeof hits, &hits), "clSetKernelArg");
    check(clSetKernelArg(kernel_, 2, sizeof number, &number), "clSetKernelArg");
    check(clEnqueueNDRangeKernel(queue_, kernel_, 1, nullptr, &count, nullptr, 0, nullptr, nullptr),
          "clEnqueueNDRangeKernel");
  }

 private:
  cl_command_queue queue_;
  cl_program program_;
  cl_kernel kernel_;
};

}  // namespace

int main(int argc, char** argv) {
  const OpenClUser user(argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0);
  const size_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 20000;
  std::mt19937 random(1);
  const auto new_ray = [&] {
    const auto number = [&](float low, float high) {
      return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
    };
    const float d[3] = {number(-1, 1), number(-0.3f, 0.3f), number(-0.3f, 0.3f)};
    const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) + 1e-9f;
    return Ray{{number(0, 28), 3, 0}, 0, {d[0] / length, d[1] / length - 0.5f, d[2] / length}};
  };
  std::vector<Ray> rays(n);
  for (Ray& ray : rays) ray = new_ray();

  size_t traced = 0, met = 0;
  constexpr int frames = 4;
  try {
    namespace kernels = wavetracer::kernels;
    SphereTracer tracer(user);
    const kernels::Context suite(user.context, user.device, user.queue);
    wavetracer::CacheConfig config;
    config.kind = "concurrent";
    config.key = "exact";
    config.buffer_size = 16 * n + 64;
    kernels::RayCache cache(suite, config, size_t{8});
    const auto batch = suite.buffer<Ray>(n);
    const auto hits = suite.buffer<Hit>(n), missed_hits = suite.buffer<Hit>(n), all_hits = suite.buffer<Hit>(n);
    for (int frame = 0; frame < frames; ++frame) {
      batch.write(rays);
      const kernels::RayCache::Misses& misses = cache.look_up(batch, n, hits);
      tracer(misses.rays.handle(), missed_hits.handle(), misses.count);
      cache.store(missed_hits, hits);
      traced += misses.count;
      // Without the cache, all rays are traced.
      tracer(batch.handle(), all_hits.handle(), n);
      const std::vector<Hit> found = hits.read(), expected = all_hits.read();
      for (size_t i = 0; i < n; ++i) {
        met += !found[i].missed();
        if (found[i].triangle == expected[i].triangle && found[i].t == expected[i].t) continue;
        std::fprintf(stderr, "%s: ray %zu of frame %d is wrong\n", user.name.c_str(), i, frame);
        return 1;
      }
      cache.next_frame();
      for (size_t i = static_cast<size_t>(frame); i < n; i += 10) rays[i] = new_ray();
    }
    const kernels::RayCacheStatistics s = cache.statistics();
    if (s.look_ups != frames * n || s.hits != frames * n - traced || met == 0 || traced > 2 * n) {
      std::fprintf(stderr, "%s: %zu rays were traced, %llu of %llu answered\n", user.name.c_str(), traced,
                   static_cast<unsigned long long>(s.hits), static_cast<unsigned long long>(s.look_ups));
      return 1;
    }
  } catch (const wavetracer::kernels::Error& error) {
    std::fprintf(stderr, "%s (OpenCL code %d, kernel \"%s\")\n", error.what(), error.code(), error.kernel().c_str());
    return 1;
  }
  std::printf("%s traced %zu of %zu rays and had the hits of all\n", user.name.c_str(), traced, frames * n);
  return 0;
}
