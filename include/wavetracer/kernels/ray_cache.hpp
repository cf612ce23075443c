// SPDX-License-Identifier: Apache-2.0
// RayCache: a table of traced rays on the device, which answers similar rays without tracing them (A. Zhdanov, TU
// Munich, 2014). A batch of rays takes three steps, of which the second is the user's:
//
//   const kernels::RayCache::Misses& misses = cache.look_up(rays, n, hits);  // answers rays, and lists the others
//   bvh.nearest(misses.rays, misses.count, traced);                          // or any tracer of your own
//   cache.store(traced, hits);                                               // into the table, and among the answers
//
// With innerframe, only the first ray of each key is listed. store() gives its hit to the other rays of the key, by the
// rules of a look-up, and lists those that cannot take it:
//
//   for (auto* m = &cache.look_up(rays, n, hits); m->count > 0; m = &cache.store(traced, hits))
//     bvh.nearest(m->rays, m->count, traced);
//
// The key of a ray is the triangle that it leaves and the cell of its direction (key = "quantised"), or the ray itself
// (key = "exact"). For a quantised key, hit_point = "own" gives a ray the point where its own line meets the plane of
// the triangle that the stored ray met, and asks that the point lies within the bounds of that triangle; "cached"
// replaces the ray by the one that was stored. purge = "position" makes entries stale when their region moves by
// position_step_m; "precision" answers only rays that are nearer to the stored one than residual_value.
//
// scope = "static" is for triangles that stand still. With "all", triangles belong to objects that may move: entries
// whose ray left or met an object are not valid any more when it has moved (move_object), but in the tables of the
// thesis. Entries whose ray it has come across since still are valid, as in the thesis.
//
// Tables (kind): "chained", binary trees over a pool of entries; "open", a slot for each hash, under locks or with
// counted readers (locking); "concurrent", buckets of tags whose readers never wait; "thesis" and "thesis-chained", as
// they are printed there, faults included. Hashes (hash_method): 1 uniform, 2 Morton, 3 mixed. CacheConfig
// (wavetracer/cache_config.hpp) has all options; first_depth and statistics have no meaning here.
#pragma once
#include <array>

#include "wavetracer/cache_config.hpp"
#include "wavetracer/kernels/bvh.hpp"
#include "wavetracer/kernels/context.hpp"
#include "wavetracer/kernels/rays.hpp"

namespace wavetracer::kernels {

// The object of a triangle that stands still.
constexpr uint32_t no_object = 0xffffffffu;

// Counts since the cache was made.
struct RayCacheStatistics {
  uint64_t look_ups = 0;
  uint64_t hits = 0;
  uint64_t shared = 0;     // rays that took the hit of another ray of their key (innerframe); look-ups are hits, shared
                           // and traced rays
  uint64_t conflicts = 0;  // look-ups that met a writer or a reader, and counted as misses
  uint64_t stale = 0;      // look-ups that found an entry of their key that is not valid any more
  uint64_t stored = 0;     // entries written
  uint64_t replaced = 0;   // those that replaced another entry
  uint64_t duplicates = 0;  // traced rays whose key was there already
  uint64_t dropped = 0;     // traced rays that found no place
  uint64_t evicted = 0;     // entries removed by purge()
  // The state now: places for entries, those in use (an open table keeps stale ones), and the memory of the table.
  uint64_t entries = 0, used = 0, bytes = 0;
};

// Cost. An entry has 64 bytes, and 12 to 16 more; a ray of the largest batch needs 180 bytes beside, with innerframe 32
// to 56 more. A look-up reads one or two sectors of memory at random; a batch moves some 250 bytes for each ray between
// records and planes. It needs 64-bit atomics.
class RayCache {
 public:
  struct State;  // the suite alone knows it

  // The rays that must be traced: rays[k] is rays[indices[k]] of the batch, for k < count, in that order. The buffers
  // are longer than count. They are valid until the next look-up, with innerframe until the next store().
  struct Misses {
    Buffer<Ray> rays;
    Buffer<uint32_t> indices;
    size_t count = 0;
  };

  // Makes an empty table of config.buffer_size entries, which the regions share evenly. A region is a place that rays
  // start from, such as a transmitter; rays of a region are answered by its entries alone. bvh: the triangles that rays
  // leave and meet, whose planes are copied. objects: with scope = "all", the object of each triangle, or no_object;
  // objects are numbered from 0, and are no more than triangles. Throws Error if a region has less than 16 entries, if
  // the device cannot hold the table, for kind = "none", for numbers outside of the ranges that docs/configuration.md
  // has, for objects that the scope does not have or lacks, and for an exact key with scope = "all" or a table of the
  // thesis.
  RayCache(const Context& context, const CacheConfig& config, const Bvh& bvh, uint32_t regions = 1,
           std::span<const uint32_t> objects = {});
  // The same for a tracer of your own, whose triangles have the numbers 0 .. triangles - 1. With scope = "static" their
  // number only spreads the hashes of methods 2 and 3. It needs an exact key, or hit_point = "cached": else Error is
  // thrown.
  RayCache(const Context& context, const CacheConfig& config, size_t triangles, uint32_t regions = 1,
           std::span<const uint32_t> objects = {});
  ~RayCache();
  RayCache(RayCache&&) noexcept;
  RayCache& operator=(RayCache&&) noexcept;

  // hits[i] becomes the answer to rays[i], with u = v = 0, or a hit of nothing at all, for i < n; elements from n on
  // stay. Directions have unit length; rays begin at t = 0 and have no end, whatever their t_min and t_max. left: the
  // triangle that each ray leaves, or no_triangle; null: none leaves any. regions: the region of each ray; null: 0.
  // With a quantised key and hit_point = "cached", answered rays are replaced. n is at most 2^31. The host waits for
  // the number of misses, with innerframe twice. Throws Error if a buffer is too short or of another context.
  const Misses& look_up(const Buffer<Ray>& rays, size_t n, const Buffer<Hit>& hits,
                        const Buffer<uint32_t>* left = nullptr, const Buffer<uint32_t>* regions = nullptr,
                        const Call& call = {});
  // traced[k] is the hit of misses.rays[k], for all misses of the last look-up. It goes into the table, and
  // hits[indices[k]] becomes it, with u = v = 0. The hits of the look-up must be given. With innerframe other rays of
  // its key become its hit as answered rays do, also in the rays of the look-up if it replaces them, and the rays that
  // cannot take it are returned: trace them and store their hits by a second call, if there are any. The host waits for
  // their number. Else none are returned. Throws Error as above, and if no look-up or store() has left rays to it.
  const Misses& store(const Buffer<Hit>& traced, const Buffer<Hit>& hits, const Call& call = {});

  // The cache counts frames, from 1 on. Begins the next one.
  void next_frame();
  // Says where the rays of a region start in this frame. If that has moved by a step, entries of earlier frames are not
  // valid any more; without purge = "position" it does nothing. Throws Error for a region that is not there.
  void place_region(uint32_t region, const std::array<double, 3>& position_m);
  // Says that an object has moved before this frame: entries of earlier frames whose ray left or met it are not valid
  // any more. Call it before the look-ups of the frame. Throws Error for an object that is not there.
  void move_object(uint32_t object);
  // Removes the entries that were neither stored nor answered in the last `frames` frames, this one included. A chained
  // table cannot remove single entries: regions in which more than half would go are cleared, and the others stay as
  // they are. Open tables and those of the thesis write over entries, and keep them all.
  void purge(uint32_t frames);
  // Removes all entries.
  void clear();

  // Waits for the queue.
  RayCacheStatistics statistics();

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
