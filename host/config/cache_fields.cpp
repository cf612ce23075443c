// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about the ray cache: its table, the fields of its keys, and the age at which entries expire.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table cache_table() {
  const auto c = [](auto member) { return at(&Config::cache, member); };
  return {
      .name = "cache",
      .doc =
          "The ray cache: segments of rays that are kept and answer later rays, which then need no tracing. "
          "Each transmitter has its own part of the cache. No key of this table has an effect while kind is none.",
      .fields = {
          {.name = "kind",
           .slot = c(&CacheConfig::kind),
           .doc = "The hash table. chained: buckets with binary trees; keeps every segment until it is full. "
                  "open: one place per key, protected by locks; the last segment replaces the one before. "
                  "concurrent: buckets of 8 entries, which rays read without locks and which fill evenly. "
                  "none: no cache, because a cache saves time only if many rays need the same segments, "
                  "and sorting the rays makes tracing faster without one. "
                  "thesis, thesis-chained: the open and the chained table as A. Zhdanov's thesis prints them, "
                  "with their faults, for comparison only: they compare no keys, so some rays get the results "
                  "of others."},
          {.name = "key",
           .slot = c(&CacheConfig::key),
           .doc = "Decides which rays share an entry. quantised: rays that leave the same primitive into the same cell "
                  "of directions, from any point on it; results are approximate, and which of two similar rays "
                  "is kept depends on chance. exact: only the same ray, bit by bit, so that the paths are the same "
                  "as without a cache; only a transmitter that stands still and launches the same directions again "
                  "gains from it. "
                  "division, purge and hit_point then have no effect."},
          {.name = "hash_method",
           .slot = c(&CacheConfig::hash_method),
           .range = {1, 3},
           .doc = "The hash function. 1 uniform: keys are spread evenly over the table. "
                  "2 Morton: similar rays are near each other, so that their entries share cache lines; "
                  "but most buckets stay empty, and only a chained table has room for more than a few segments. "
                  "3 mixed: the sum of both."},
          {.name = "division",
           .slot = c(&CacheConfig::division),
           .unit = "cells per direction component",
           .range = {1, 2097151},
           .doc = "Only with key = \"quantised\". Fewer cells answer more rays and make larger errors: "
                  "the answer belongs to a ray whose direction differs by up to 2 / division in each component and "
                  "which starts elsewhere on the primitive. 200000, as in the thesis."},
          {.name = "buffer_size",
           .slot = c(&CacheConfig::buffer_size),
           .unit = "entries",
           .range = {16, 2147483648.0},
           .doc = "The number of entries of the table. An entry takes 64 bytes, and some more for the index; "
                  "the transmitters share the entries evenly. If the table is too small, segments are dropped "
                  "or overwritten and traced again, which costs time but no paths."},
          {.name = "load_factor",
           .slot = c(&CacheConfig::load_factor),
           .unit = "entries per bucket",
           .range = {1, 64},
           .doc = "Only with kind = \"chained\" or \"thesis-chained\": the average number of entries per bucket in "
                  "a full table. A larger number takes less memory and makes deeper trees. 3, as in the thesis."},
          {.name = "locking",
           .slot = c(&CacheConfig::locking),
           .doc = "Only with kind = \"open\" or \"thesis\". mutex: one ray at a time uses an entry; "
                  "other rays that ask for it meanwhile are traced. readers: the lock for readers "
                  "and writers of the thesis; an entry must be renewed after readers_number reads."},
          {.name = "readers_number",
           .slot = c(&CacheConfig::readers_number),
           .unit = "reads",
           .range = {1, 65535},
           .doc = "Only with locking = \"readers\": after this many reads an entry answers no more rays until it "
                  "is traced and written again. More reads save more time and keep an old result longer. "
                  "5, as in the thesis."},
          {.name = "purge",
           .slot = c(&CacheConfig::purge),
           .doc = "Only with key = \"quantised\": which entries of a moving transmitter are out of date. "
                  "position: all its entries, when it enters another cell of size position_step_m. "
                  "precision: an entry whose ray differs by more than residual_value from the ray that asks; "
                  "this keeps more entries during a drive, "
                  "but tests every answer."},
          {.name = "position_step_m",
           .slot = c(&CacheConfig::position_step_m),
           .unit = "m",
           .range = {0.001, 1000},
           .doc = "Only with purge = \"position\": the side of the cells of the transmitter's position. "
                  "With scope = \"all\": how far a vehicle may move before the entries that hit it are out "
                  "of date. Larger steps keep entries for more frames, with results for earlier positions."},
          {.name = "residual_value",
           .slot = c(&CacheConfig::residual_value),
           .unit = "L1 norm of metres and direction components",
           .range = {0, 1e6},
           .doc = "Only with purge = \"precision\": the largest allowed difference between the ray that asks "
                  "and the ray that was traced. It is the sum of the absolute differences of origin (m) "
                  "and direction, six components. A larger value answers more rays and makes larger errors. "
                  "0.0125, as in the thesis."},
          {.name = "scope",
           .slot = c(&CacheConfig::scope),
           .doc = "The contents of the entries. static: hits on the static scene only; "
                  "vehicles and receivers are tested for every segment, so nothing that moves is missed. "
                  "all: vehicles and receivers too, as in the thesis; this saves those tests, but misses a vehicle "
                  "or receiver that has moved into a segment after it was traced."},
          {.name = "hit_point",
           .slot = c(&CacheConfig::hit_point),
           .doc = "Only with key = \"quantised\": where a ray that the cache has answered continues. "
                  "own: where its own line meets the plane of the cached surface; "
                  "if that point is outside the surface, the ray is traced. "
                  "cached: at the hit point of the other ray, as in the thesis; this saves a few operations, "
                  "but errors add up along the path."},
          {.name = "first_depth",
           .slot = c(&CacheConfig::first_depth),
           .unit = "segments of a ray, counted from 1",
           .range = {1, 64},
           .doc = "The first segment of a ray that the cache may answer; earlier segments are always traced. "
                  "Neighbouring rays are launched together, so a cache saves least at the first segments. "
                  "1: all segments may be answered."},
          {.name = "innerframe",
           .slot = c(&CacheConfig::innerframe),
           .doc = "Coherence inside a frame: of the rays of one depth that have the same key "
                  "and are not in the table, "
                  "only one is traced, and the others take its hit, as hit_point and purge say. "
                  "false: all of them are traced and then stored, because finding the groups costs time, "
                  "and few rays share a key unless division is small. With key = \"exact\" the paths are the same "
                  "in both cases."},
          {.name = "statistics",
           .slot = c(&CacheConfig::statistics),
           .doc = "Count the hits of each entry, and how often a ray follows the entries of an earlier ray, "
                  "for summary.json. It costs one atomic operation per hit."},
      }};
}

}  // namespace wavetracer::config
