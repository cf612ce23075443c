// SPDX-License-Identifier: Apache-2.0
// The public face of the pass Scan.
// It differs from the pass in that the total stays on the device.
#include "wavetracer/kernels/scan.hpp"

#include "kernel_suite/state.hpp"
#include "passes/scan.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* scan_name = "Scan";

}  // namespace

struct Scan::State : PassState {
  explicit State(const Context& of) : PassState(of), scan(context->gpu) {}
  wavetracer::Scan scan;
};

Scan::Scan(const Context& context) : state_(with_errors([&] { return std::make_unique<State>(context); })) {}
Scan::~Scan() = default;
Scan::Scan(Scan&&) noexcept = default;
Scan& Scan::operator=(Scan&&) noexcept = default;

void Scan::operator()(const Buffer<uint32_t>& words, size_t n, const Call& call) {
  const uint32_t count = count_of(scan_name, n);
  gpu::Buffer<uint32_t> counts = buffer_of(*state_, scan_name, "words", words, n);
  enqueue(*state_, call, [&] { state_->scan.prefix(counts, count); });
}

void Scan::operator()(const Buffer<uint32_t>& words, size_t n, const Buffer<uint32_t>& total, const Call& call) {
  const uint32_t count = count_of(scan_name, n);
  gpu::Buffer<uint32_t> counts = buffer_of(*state_, scan_name, "words", words, n);
  gpu::Buffer<uint32_t> sum = buffer_of(*state_, scan_name, "total", total, 1);
  enqueue(*state_, call, [&] { state_->scan.prefix(counts, count, sum); });
}

}  // namespace wavetracer::kernels
