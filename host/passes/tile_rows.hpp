// SPDX-License-Identifier: Apache-2.0
// The number of paths by tiles or cells that a device can hold.
#pragma once
#include <cstdint>
#include <string>

#include "passes/solved_list.hpp"

namespace wavetracer {

// Makes room for this many rows, and returns their number. Throws RuntimeError, naming trace.tile_m, for more than
// buffers hold.
uint32_t reserve_tile_rows(gpu::Context& context, SolvedList& list, uint64_t rows);

// The same for other rows. what: a text with {} for their number, as "targets have {} paths to test"; advice: the end
// of the message.
uint32_t reserve_point_rows(gpu::Context& context, SolvedList& list, uint64_t rows, const char* what,
                            const std::string& advice);

}  // namespace wavetracer
