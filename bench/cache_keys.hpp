// SPDX-License-Identifier: Apache-2.0
// Computes on the host how evenly the hashes of the ray cache spread the rays of a real scene over buckets.
// Rays must be labelled, see cache_rays.hpp.
#pragma once
#include <span>
#include <vector>

#include "cache_rays.hpp"
#include "wavetracer/device/cache.h"

namespace wavetracer::bench {

struct RayKey {
  uint64_t cells;
  uint32_t left, surface;
};

// Returns the keys of all rays, each once.
std::vector<RayKey> distinct_keys(const SceneRays& rays, uint32_t division);

struct Spread {
  double occupied;    // share of the buckets that have a key
  uint32_t longest;   // number of keys of the fullest bucket
  double chi_square;  // per degree of freedom: 1 if keys fall at random
  double overflow;    // share of the keys for which a concurrent table at load 0.8 has no place
};
// The number of buckets is that of the chained table at its default load factor of 3.
Spread spread(std::span<const RayKey> keys, uint32_t hash_method, device::wt_cache_widths widths);

}  // namespace wavetracer::bench
