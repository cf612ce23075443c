// SPDX-License-Identifier: Apache-2.0
#include "simulation/receiver_batches.hpp"

#include <algorithm>

namespace wavetracer {
namespace {

constexpr uint32_t least_receivers = 8192;  // a batch has them, unless the user asks for fewer
// A receiver that launches rays has some 300 to 1500 sequences of about 350 bytes, one that hears edges some 100; they
// may take a quarter of the memory.
uint64_t bytes_of_launching(const TraceConfig& trace) { return uint64_t{4} * 350 * (trace.from_edges() ? 300 : 1500); }

// The rows of a receiver that launches nothing, some 32 paths of 600 bytes with all lists; they may take a quarter of
// the memory.
constexpr uint64_t bytes_of_rows = uint64_t{4} * 32 * 600;

}  // namespace

std::vector<ReceiverRange> receiver_batches(const TraceConfig& trace, uint32_t receiver_count, uint64_t memory,
                                            uint32_t most, bool summed) {
  const uint64_t bytes = trace.from_both_ends() ? bytes_of_launching(trace) : bytes_of_rows;
  const auto fitting = static_cast<uint32_t>(std::clamp<uint64_t>(memory / bytes, least_receivers, no_end));
  const uint32_t asked = trace.from_both_ends() || summed ? trace.batch_receivers.value_or(fitting) : no_end;
  const uint32_t batch = std::min(asked, most);
  if (receiver_count <= batch) return {{}};
  std::vector<ReceiverRange> out;
  for (uint32_t first = 0; first < receiver_count; first += std::min(batch, receiver_count - first))
    out.push_back({first, first + std::min(batch, receiver_count - first)});
  return out;
}

}  // namespace wavetracer
