// SPDX-License-Identifier: Apache-2.0
// The integral and the field of facets have the same bits on the device and on the host.
#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/facet.h"

using namespace wavetracer;

namespace {

glm::dvec3 vector_at(const double* x) { return {x[0], x[1], x[2]}; }

// The same lines as those of tests/kernels/probe_facet.cl.
void facet_on_host(const double* x, double* y) {
  using namespace device;
  const wt_double2 integral = wt_triangle_mean(x[0], x[1], x[2]) * x[16];
  const wt_double2 amplitude = wt_facet_amplitude(integral, x[17]);
  const glm::dvec3 k_in = vector_at(x + 3), k_out = vector_at(x + 6), normal = vector_at(x + 9);
  const wt_matrix m = wt_facet_matrix(k_in, k_out, normal, {x[12], x[13]}, {x[14], x[15]}, wt_spherical_basis(-k_out));
  y[0] = amplitude.x;
  y[1] = amplitude.y;
  for (int k = 0; k < 4; ++k) {
    y[2 + 2 * k] = m.m[k].x;
    y[3 + 2 * k] = m.m[k].y;
  }
}

}  // namespace

TEST_CASE("facets have the same bits on the device and on the host") {
  constexpr size_t count = 4000;
  std::mt19937_64 random(4);
  std::normal_distribution<double> draw;
  std::vector<double> in(18 * count), expected(10 * count);
  for (size_t i = 0; i < count; ++i) {
    double* x = in.data() + 18 * i;
    const double spread = std::exp2(static_cast<double>(i % 40) - 30);
    for (int k = 0; k < 3; ++k) x[k] = spread * draw(random);
    for (int d = 3; d < 12; d += 3) {
      glm::dvec3 v(draw(random), draw(random), draw(random));
      v /= std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
      for (int k = 0; k < 3; ++k) x[d + k] = v[k];
    }
    for (int k = 12; k < 16; ++k) x[k] = draw(random);
    x[16] = std::abs(draw(random));
    x[17] = 0.004;
    facet_on_host(x, expected.data() + 10 * i);
  }
  gpu::Context context;
  auto from = context.buffer<double>(in.size(), "in");
  auto to = context.buffer<double>(expected.size(), "out");
  from.write(in);
  context.kernel("probe_facet", "facets")({count, 16}, Stage::transfer, from, static_cast<uint32_t>(count), to);
  CHECK(to.read() == expected);
}
