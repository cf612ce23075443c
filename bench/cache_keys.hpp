// How evenly the hashes of the ray cache spread the rays of a real scene over buckets, on the host.
// Assumes that rays and hits are those of segments.hpp.
#pragma once
#include <span>
#include <vector>

#include "segments.hpp"
#include "wavetracer/device/cache.h"

namespace wavetracer::bench {

struct RayKey {
  uint64_t cells;
  uint32_t left, surface;
};

// Keys of the rays that next_segment makes of `rays`, in its order.
void add_keys(std::vector<RayKey>& keys, std::span<const Ray> next, std::span<const Hit> hits,
              std::span<const AccelTriangle> triangles, uint32_t division);

// Each key once.
std::vector<RayKey> distinct(std::vector<RayKey> keys);

struct Spread {
  double occupied;    // share of the buckets that have a key
  uint32_t longest;   // keys of the fullest bucket
  double chi_square;  // a degree of freedom: 1 where keys fall as they may
  double overflow;    // share of the keys that a concurrent table at load 0.8 finds no place for
};
// Over as many buckets as the chained table has at its default load factor of 3.
Spread spread(std::span<const RayKey> keys, uint32_t hash_method, device::wt_cache_widths widths);

}  // namespace wavetracer::bench
