// How evenly the hashes of the ray cache spread the rays of a real scene over buckets, on the host.
// Assumes labelled rays, see cache_rays.hpp.
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

// The keys of all rays, each once.
std::vector<RayKey> distinct_keys(const SceneRays& rays, uint32_t division);

struct Spread {
  double occupied;    // share of the buckets that have a key
  uint32_t longest;   // keys of the fullest bucket
  double chi_square;  // a degree of freedom: 1 where keys fall as they may
  double overflow;    // share of the keys that a concurrent table at load 0.8 finds no place for
};
// Over as many buckets as the chained table has at its default load factor of 3.
Spread spread(std::span<const RayKey> keys, uint32_t hash_method, device::wt_cache_widths widths);

}  // namespace wavetracer::bench
