// SPDX-License-Identifier: Apache-2.0
// The part of the configuration about the ray cache, and the questions that code asks of it.
// Defaults are defined here; the field table (host/config) gives the reason for each.
#pragma once
#include <cstdint>

#include "wavetracer/choice.hpp"

namespace wavetracer {

using CacheKind = Choice<"none", "chained", "open", "concurrent", "thesis", "thesis-chained">;
using CacheKey = Choice<"quantised", "exact">;
using CacheLocking = Choice<"mutex", "readers">;
using CachePurging = Choice<"position", "precision">;
using CacheScope = Choice<"static", "all">;
using CacheHitPoint = Choice<"own", "cached">;

struct CacheConfig {
  CacheKind kind = "none";
  CacheKey key = "quantised";        // quantised: primitive and cells of directions; exact: the ray itself
  uint32_t hash_method = 3;          // 1 uniform, 2 Morton, 3 mixed
  uint32_t division = 200000;        // cells per direction component, of a quantised key
  uint64_t buffer_size = 1048576;    // entries, shared evenly by the transmitters
  double load_factor = 3;            // chained: entries per bucket, on average
  CacheLocking locking = "readers";  // only for an open table
  uint32_t readers_number = 5;       // open, readers: an entry must be renewed after this many reads
  CachePurging purge = "position";
  double position_step_m = 0.1;     // step of the transmitter's position key
  double residual_value = 0.0125;   // precision: largest L1 distance of origins and directions
  CacheScope scope = "static";      // static: vehicles and receivers are tested every time; all: they are cached too
  CacheHitPoint hit_point = "own";  // of an answered ray: own (its line meets the surface), cached (of the other ray)
  uint32_t first_depth = 1;         // segments before this one of a ray, counted from 1, are always traced
  bool innerframe = false;          // trace one ray of each group of equal keys at a depth; the others take its hit
  bool statistics = false;          // count hits per entry, and entries linked along paths

  bool on() const { return kind != "none"; }
  // One of the thesis' tables, faults included.
  bool as_printed() const { return kind == "thesis" || kind == "thesis-chained"; }
  // The entries of a bucket are linked into a tree.
  bool linked() const { return kind == "chained" || kind == "thesis-chained"; }
  // Linked entries are taken from the pool of a region, which can be exhausted.
  bool pooled() const { return kind == "chained"; }
  // Each hash has one slot, and a later entry is written over the one that is there.
  bool in_slots() const { return kind == "open" || kind == "thesis"; }
  // Each hash has a bucket of WT_CACHE_BUCKET slots.
  bool in_buckets() const { return kind == "concurrent"; }
  // Uses are recorded, and entries evicted. Other kinds overwrite entries, or, as printed, are never cleared.
  bool evicts() const { return kind == "chained" || kind == "concurrent"; }
  // The slots of an open table are locked; otherwise readers are counted.
  bool locks() const { return locking == "mutex"; }
  // The key is the ray itself: an answer is that of the same ray.
  bool exact() const { return key == "exact"; }
  // Entries of quantised keys are stale when the transmitter has moved by a step.
  bool by_position() const { return !exact() && purge == "position"; }
  // Entries of quantised keys answer rays that are close enough.
  bool by_precision() const { return !exact() && purge == "precision"; }
  // Entries hold hits of vehicles and receivers, too, not of the static scene alone.
  bool holds_all() const { return scope == "all"; }
  // An answered ray gets the point where its own line meets the surface, not that of the ray that was stored.
  bool own_points() const { return hit_point == "own"; }
};

}  // namespace wavetracer
