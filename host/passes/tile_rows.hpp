// How many paths by tiles or cells a device can hold.
#pragma once
#include <cstdint>

#include "passes/solved_list.hpp"

namespace wavetracer {

// Room for so many rows, which are returned. Throws RuntimeError, naming trace.tile_m, for more than buffers hold.
uint32_t reserve_tile_rows(gpu::Context& context, SolvedList& list, uint64_t rows);

}  // namespace wavetracer
