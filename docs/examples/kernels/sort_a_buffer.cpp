// SPDX-License-Identifier: Apache-2.0
// Sorts a buffer of your own in your own queue: sort_a_buffer [DEVICE [KEYS]]
// DEVICE is the index of an OpenCL device, counted over all platforms (default 0); KEYS is how many (default 2^20).
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "opencl_user.hpp"
#include "wavetracer/kernels/sort.hpp"

int main(int argc, char** argv) {
  // Everything here is the user's: context, queue, memory and events.
  const OpenClUser user(argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0);
  const size_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : size_t{1} << 20;
  const cl_mem memory = user.memory(n * sizeof(uint32_t));
  std::vector<uint32_t> keys(n);
  std::mt19937 random(1);
  for (uint32_t& key : keys) key = static_cast<uint32_t>(random());

  double seconds = 0;
  try {
    namespace kernels = wavetracer::kernels;
    const kernels::Context suite(user.context, user.device, user.queue);
    const auto buffer = suite.wrap<uint32_t>(memory);  // no copy
    kernels::Sort sort(suite, {.key_bits = 32});
    sort.reserve(n);
    for (int round = 0; round < 3; ++round) {  // the first one may compile
      cl_event written = nullptr, sorted = nullptr;
      check(
          clEnqueueWriteBuffer(user.queue, memory, CL_TRUE, 0, n * sizeof(uint32_t), keys.data(), 0, nullptr, &written),
          "clEnqueueWriteBuffer");
      const auto start = std::chrono::steady_clock::now();
      sort(buffer, n, {}, {.after = {&written, 1}, .done = &sorted});
      check(clWaitForEvents(1, &sorted), "clWaitForEvents");
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      clReleaseEvent(written);
      clReleaseEvent(sorted);
    }
  } catch (const wavetracer::kernels::Error& error) {
    std::fprintf(stderr, "%s (OpenCL code %d, kernel \"%s\")\n", error.what(), error.code(), error.kernel().c_str());
    return 1;
  }

  const std::vector<uint32_t> sorted = user.read<uint32_t>(memory, n);
  std::sort(keys.begin(), keys.end());
  clReleaseMemObject(memory);
  if (sorted != keys) {
    std::fprintf(stderr, "%s sorted %zu keys wrongly\n", user.name.c_str(), n);
    return 1;
  }
  std::printf("%s sorted %zu keys as std::sort does, in %.3f ms\n", user.name.c_str(), n, 1e3 * seconds);
  return 0;
}
