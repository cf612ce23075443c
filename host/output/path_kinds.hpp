// SPDX-License-Identifier: Apache-2.0
// Counts paths of each kind. A path counts once, by its most special interaction: scattered if it scatters anywhere,
// else diffracted, else transmitted, else reflected; a path without interactions is line of sight.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {

// Counts for each of path_kinds; they add up to the number of paths.
using PathKindCounts = std::array<uint64_t, path_kinds.size()>;

// path: a row of paths. Returns an index into path_kinds.
size_t path_kind(const Paths& paths, size_t path);

PathKindCounts count_path_kinds(const Paths& paths);

}  // namespace wavetracer
