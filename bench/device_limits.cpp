// SPDX-License-Identifier: Apache-2.0
// tests/kernels/probe_arithmetic.cl measures arithmetic: chains of fused multiplies and adds.
// GPUs need one lane per work-item, CPUs vectors: the better of both counts.
#include "device_limits.hpp"

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

}  // namespace

DeviceLimits measure_limits(gpu::Context& context, size_t runs) {
  DeviceLimits limits;
  limits.bytes_s = copy_bandwidth(context, runs);
  limits.singles_s =
      std::max(operations_per_second<float>(context, runs, 1), operations_per_second<float>(context, runs, 16));
  limits.doubles_s =
      std::max(operations_per_second<double>(context, runs, 1), operations_per_second<double>(context, runs, 8));
  limits.launch_s = shortest_launch(context, runs);
  return limits;
}

}  // namespace wavetracer::bench
