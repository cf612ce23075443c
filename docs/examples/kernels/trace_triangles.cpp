// SPDX-License-Identifier: Apache-2.0
// Traces triangles of your own: trace_triangles [DEVICE [RAYS]]
// DEVICE is the index of an OpenCL device, counted over all platforms (default 0); RAYS is how many (default 2000).
#include <cmath>
#include <cstdint>
#include <random>

#include "opencl_user.hpp"
#include "wavetracer/kernels/bvh.hpp"

namespace {

using wavetracer::kernels::Hit;
using wavetracer::kernels::Ray;

// A hilly ground of 2 * side^2 triangles.
std::vector<float> ground(int side) {
  const auto height = [](int x, int y) {
    return std::sin(0.7f * static_cast<float>(x)) * std::cos(0.5f * static_cast<float>(y));
  };
  std::vector<float> corners;
  const auto corner = [&](int x, int y) {
    corners.insert(corners.end(), {static_cast<float>(x), static_cast<float>(y), height(x, y)});
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      for (const int k : {0, 1, 2}) corner(x + (k == 1), y + (k == 2));
      for (const int k : {0, 1, 2}) corner(x + (k != 2), y + (k != 1));
    }
  return corners;
}

// The t at which a ray meets a triangle, by the test of Möller and Trumbore, else infinity. *beside: the ray passes a
// side of the triangle so closely that rounding decides.
double met_at(const Ray& ray, const float* c, bool* beside) {
  const double endless = std::numeric_limits<double>::infinity();
  double ab[3], ac[3], s[3];
  for (int k = 0; k < 3; ++k) {
    ab[k] = double{c[3 + k]} - c[k];
    ac[k] = double{c[6 + k]} - c[k];
    s[k] = double{ray.origin[k]} - c[k];
  }
  const float* d = ray.direction;
  const double p[3] = {d[1] * ac[2] - d[2] * ac[1], d[2] * ac[0] - d[0] * ac[2], d[0] * ac[1] - d[1] * ac[0]};
  const double det = ab[0] * p[0] + ab[1] * p[1] + ab[2] * p[2];
  if (det == 0) return endless;
  const double q[3] = {s[1] * ab[2] - s[2] * ab[1], s[2] * ab[0] - s[0] * ab[2], s[0] * ab[1] - s[1] * ab[0]};
  const double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det, v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / det;
  const double t = (ac[0] * q[0] + ac[1] * q[1] + ac[2] * q[2]) / det;
  const double inside = std::fmin(std::fmin(u, v), 1 - u - v);
  if (t > 0 && std::fabs(inside) < 1e-4) *beside = true;
  return inside >= 0 && t > 0 ? t : endless;
}

bool is_right(const Ray& ray, const Hit& hit, uint32_t met, const std::vector<float>& corners) {
  double nearest = std::numeric_limits<double>::infinity();
  bool beside = false;
  for (size_t i = 0; i < corners.size() / 9; ++i)
    nearest = std::fmin(nearest, met_at(ray, corners.data() + 9 * i, &beside));
  if (hit.missed() != (met == 0)) return false;
  if (beside) return true;
  return std::isinf(nearest) ? hit.missed() : std::fabs(double{hit.t} - nearest) < 1e-3;
}

}  // namespace

int main(int argc, char** argv) {
  const OpenClUser user(argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0);
  const size_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2000;
  constexpr int side = 24;
  const std::vector<float> corners = ground(side);
  std::mt19937 random(1);
  const auto number = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
  };
  std::vector<Ray> rays(n);
  for (Ray& ray : rays) {
    const float from[3] = {number(0, side), number(0, side), 5},
                to[3] = {number(-5, side + 5), number(-5, side + 5), 0};
    for (int k = 0; k < 3; ++k) {
      ray.origin[k] = from[k];
      ray.direction[k] = to[k] - from[k];
    }
  }
  const cl_mem own_rays = user.memory(rays), own_hits = user.memory(n * sizeof(Hit));

  std::vector<uint32_t> any;
  try {
    namespace kernels = wavetracer::kernels;
    const kernels::Context suite(user.context, user.device, user.queue);
    kernels::Bvh bvh(suite, corners);
    const auto met = suite.buffer<uint32_t>(n);
    bvh.nearest(suite.wrap<Ray>(own_rays), n, suite.wrap<Hit>(own_hits));
    bvh.any(suite.wrap<Ray>(own_rays), n, met);
    any = met.read();
  } catch (const wavetracer::kernels::Error& error) {
    std::fprintf(stderr, "%s (OpenCL code %d, kernel \"%s\")\n", error.what(), error.code(), error.kernel().c_str());
    return 1;
  }
  const std::vector<Hit> hits = user.read<Hit>(own_hits, n);
  clReleaseMemObject(own_rays);
  clReleaseMemObject(own_hits);
  size_t met = 0;
  for (size_t i = 0; i < n; ++i) {
    met += any[i];
    if (is_right(rays[i], hits[i], any[i], corners)) continue;
    std::fprintf(stderr, "%s traced ray %zu of %zu wrongly\n", user.name.c_str(), i, n);
    return 1;
  }
  std::printf("%s traced %zu rays, of which %zu meet one of %zu triangles, as all triangles in turn say\n",
              user.name.c_str(), n, met, corners.size() / 9);
  return 0;
}
