// SPDX-License-Identifier: Apache-2.0
// Puts points of your own into Morton order: morton_order [DEVICE [POINTS]]
// DEVICE is the index of an OpenCL device, counted over all platforms (default 0); POINTS is how many (default 2^18).
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>

#include "opencl_user.hpp"
#include "wavetracer/kernels/curves.hpp"
#include "wavetracer/kernels/sort.hpp"

namespace {

constexpr uint32_t cells = 1024;

// The Morton key of a point in the unit cube, bit by bit.
uint32_t host_key(const float* point) {
  uint32_t key = 0;
  for (uint32_t bit = 0; bit < 10; ++bit)
    for (uint32_t d = 0; d < 3; ++d) {
      const uint32_t cell = std::min(cells - 1, static_cast<uint32_t>(point[d] * cells));
      key |= (cell >> bit & 1) << (3 * bit + d);
    }
  return key;
}

}  // namespace

int main(int argc, char** argv) {
  const OpenClUser user(argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0);
  const size_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : size_t{1} << 18;
  std::mt19937 random(1);
  std::vector<float> points(3 * n);
  for (float& x : points) x = static_cast<float>(random() >> 8) * 0x1p-24f;
  const cl_mem memory = user.memory(points);

  std::vector<uint32_t> order;
  try {
    namespace kernels = wavetracer::kernels;
    const kernels::Context suite(user.context, user.device, user.queue);
    kernels::CurveKeys keys_of(suite, kernels::Curve::morton3);
    kernels::Sort sort(suite, {.key_bits = 32, .payload = kernels::Payload::index});
    const auto keys = suite.buffer<uint32_t>(n), places = suite.buffer<uint32_t>(n);
    const std::vector<float> lower(3, 0.0f), upper(3, 1.0f);
    keys_of(suite.wrap<float>(memory), n, {lower, upper, cells}, keys);
    sort(keys, places, n, {0, keys_of.bits(cells)});
    order = places.read();
  } catch (const wavetracer::kernels::Error& error) {
    std::fprintf(stderr, "%s (OpenCL code %d, kernel \"%s\")\n", error.what(), error.code(), error.kernel().c_str());
    return 1;
  }
  clReleaseMemObject(memory);

  std::vector<uint32_t> expected(n), keys(n);
  std::iota(expected.begin(), expected.end(), 0u);
  for (size_t i = 0; i < n; ++i) keys[i] = host_key(points.data() + 3 * i);
  std::stable_sort(expected.begin(), expected.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  if (order != expected) {
    std::fprintf(stderr, "%s ordered %zu points wrongly\n", user.name.c_str(), n);
    return 1;
  }
  std::printf("%s put %zu points into Morton order as std::stable_sort does\n", user.name.c_str(), n);
  return 0;
}
