// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/primitives/scan.cl.
// The host waits for the total: it is the only number that the frame loop reads at each depth.
#include "passes/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

namespace wavetracer {

namespace {

constexpr uint32_t most_chunks = ScanTuning::most_chunks;

}  // namespace

Scan::Scan(gpu::Context& context) : Scan(context, tuning_of(context.info()).scan) {}

Scan::Scan(gpu::Context& context, const ScanTuning& form)
    : context_(context),
      form_(form),
      sums_(context.buffer<uint32_t>(most_chunks, "scan sums")),
      total_(context.buffer<uint32_t>(1, "scan total")) {
  const gpu::Definitions definitions = {{"WT_SCAN_ITEMS", std::to_string(form.items) + "u"}};
  scan_sums_ = {context, definitions};
  scan_ = {context, definitions};
}

void Scan::prefix(gpu::Buffer<uint32_t>& counts, uint32_t count, Stage stage) {
  if (count != 0) prefix(counts, count, total_, stage);
}

void Scan::prefix(gpu::Buffer<uint32_t>& counts, uint32_t count, gpu::Buffer<uint32_t>& total, Stage stage) {
  if (count > counts.size())
    throw std::invalid_argument(fmt::format("scan: {} counts of a buffer of {}", count, counts.size()));
  if (total.size() == 0) throw std::invalid_argument("scan: no room for the total");
  if (count == 0) {
    const uint32_t nothing = 0;
    context_.fill(total, &nothing, sizeof nothing, 0, sizeof nothing, stage);
    return;
  }
  const uint64_t tile = 4 * uint64_t{form_.items};
  const uint64_t wanted = count <= form_.alone ? 1 : std::clamp(form_.chunks, 1u, most_chunks);
  // A chunk of 2^32 counts and more, which only a single chunk can have, ends with the counts.
  const uint64_t chunk = ((count + wanted - 1) / wanted + tile - 1) / tile * tile;
  const uint64_t groups = (count + chunk - 1) / chunk;
  const auto words = static_cast<uint32_t>(std::min(chunk, uint64_t{~0u}));
  if (groups > 1)
    scan_sums_({groups * form_.items, form_.items}, stage,
               calls::scan::scan_sums{.counts = counts, .count = count, .chunk = words, .sums = sums_});
  scan_({groups * form_.items, form_.items}, stage,
        calls::scan::scan{.counts = counts, .count = count, .chunk = words, .sums = sums_, .total = total});
}

uint32_t Scan::operator()(gpu::Buffer<uint32_t>& counts, uint32_t count, Stage stage) {
  prefix(counts, count, stage);
  return count == 0 ? 0 : total_.read_one(0, stage);
}

}  // namespace wavetracer
