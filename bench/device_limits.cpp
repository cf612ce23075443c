// SPDX-License-Identifier: Apache-2.0
// tests/kernels/probe_arithmetic.cl measures arithmetic: chains of fused multiplies and adds.
// GPUs need one lane per work-item, CPUs vectors: the better of both counts.
#include "device_limits.hpp"

#include <algorithm>
#include <string>

#include "timing.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t chains = 8;  // number of chains of the kernel

template <class Scalar>
double operations_per_second(gpu::Context& context, size_t runs, uint32_t lanes) {
  const std::string scalar = sizeof(Scalar) == 8 ? "double" : "float";
  gpu::Kernel kernel =
      context.kernel("probe_arithmetic", "arithmetic", {{"WT_SCALAR", scalar}, {"WT_LANES", std::to_string(lanes)}});
  const uint32_t items = context.info().cpu ? 1u << 12 : 1u << 20, rounds = context.info().cpu ? 1u << 13 : 1u << 12;
  auto out = context.buffer<Scalar>(size_t{items} * lanes, "sums");
  const gpu::Range range{items, context.info().cpu ? 16u : 256u};
  kernel(range, Stage::transfer, out, Scalar{0.5}, 1u);
  std::vector<double> seconds;
  for (size_t run = 0; run < runs; run++) {
    context.finish();
    context.reset_profile();
    kernel(range, Stage::transfer, out, Scalar{0.5}, rounds);
    seconds.push_back(device_seconds(context));
  }
  return 2.0 * items * rounds * chains * lanes / median(seconds);
}

double shortest_launch(gpu::Context& context, size_t runs) {
  gpu::Kernel kernel = context.kernel("refine", "count_met");
  const auto hits = context.buffer<uint32_t>(1, "hits"), met = context.buffer<uint32_t>(2, "met");
  double shortest = 1;
  for (size_t run = 0; run < 10 * runs; run++) {
    context.finish();
    context.reset_profile();
    kernel({1, 1}, Stage::transfer, hits, 1u, met);
    shortest = std::min(shortest, device_seconds(context));
  }
  return shortest;
}

// Returns the places of memory that are read at random per second, by probe_cache_rate.cl.
double places_per_second(gpu::Context& context, size_t runs, const char* kernel, size_t place_bytes) {
  const bool cpu = context.info().cpu;
  const size_t bytes = std::min(uint64_t{cpu ? 256u : 1024u} << 20, context.info().max_buffer / 4);
  const uint32_t count = 1u << (cpu ? 20 : 26);
  gpu::Kernel run =
      context.kernel("probe_cache_rate", kernel,
                     {{"WT_CACHE_DIVISION", "200000u"}, {"WT_CACHE_HASH_METHOD", "3"}, {"WT_CACHE_CONCURRENT", "1"}});
  auto memory = context.buffer<uint64_t>(bytes / sizeof(uint64_t), "gathered memory");
  auto out = context.buffer<uint32_t>(count, "gathered words");
  context.fill(memory, 1u);
  std::vector<double> seconds;
  for (size_t i = 0; i <= runs; i++) {
    context.finish();
    context.reset_profile();
    run({count, context.info().simple_local_size()}, Stage::transfer, memory,
        static_cast<uint32_t>(bytes / place_bytes), count, out);
    if (i > 0) seconds.push_back(device_seconds(context));
  }
  return count / median(seconds);
}

}  // namespace

DeviceLimits measure_limits(gpu::Context& context, size_t runs) {
  DeviceLimits limits;
  limits.bytes_s = copy_bandwidth(context, runs);
  limits.slots_s = places_per_second(context, runs, "gather_slots", 64);
  limits.words_s = places_per_second(context, runs, "gather_words", 8);
  limits.singles_s =
      std::max(operations_per_second<float>(context, runs, 1), operations_per_second<float>(context, runs, 16));
  limits.doubles_s =
      std::max(operations_per_second<double>(context, runs, 1), operations_per_second<double>(context, runs, 8));
  limits.launch_s = shortest_launch(context, runs);
  return limits;
}

}  // namespace wavetracer::bench
