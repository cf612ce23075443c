// SPDX-License-Identifier: Apache-2.0
// A list grows to a quarter more than is asked for, as far as the device allows.
#include "passes/tile_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wavetracer/error.hpp"

namespace wavetracer {

uint32_t reserve_point_rows(gpu::Context& context, SolvedList& list, uint64_t rows, const char* what,
                            const std::string& advice) {
  const uint64_t row_bytes = 3 * sizeof(double) * list.max_depth;  // the largest of the list's buffers
  const uint64_t most = std::min<uint64_t>(context.info().max_buffer / row_bytes, 0xFFFFFFFFu);
  if (rows > most)
    throw RuntimeError(fmt::format(fmt::runtime(what), rows) +
                       fmt::format(" in this frame, and buffers of {} hold {}{}", context.info().name, most, advice));
  if (rows > 0 && (!list.headers || rows > list.headers.size())) list.reserve(context, std::min(rows + rows / 4, most));
  return static_cast<uint32_t>(rows);
}

uint32_t reserve_tile_rows(gpu::Context& context, SolvedList& list, uint64_t rows) {
  return reserve_point_rows(context, list, rows, "diffuse scattering has {} paths by tiles to test",
                            ": raise trace.tile_m (twice as long tiles are a quarter as many), ask for fewer links, or "
                            "choose a device with more memory");
}

}  // namespace wavetracer
