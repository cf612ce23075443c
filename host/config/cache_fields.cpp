// Rows of the field table about the ray cache: its table, what its keys tell apart, and what makes entries stale.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table cache_table() {
  const auto c = [](auto member) { return at(&Config::cache, member); };
  return {
      .name = "cache",
      .doc =
          "Segments that are kept and answer later rays instead of tracing them, one region of the table a "
          "transmitter. Without effect while kind is none.",
      .fields = {
          {.name = "kind",
           .slot = c(&CacheConfig::kind),
           .doc = "The table. chained: buckets of binary trees, keeps every segment until it is full. open: one place "
                  "a key, under locks, where the last segment wins. concurrent: buckets of 8, which rays read without "
                  "locks and which fill evenly. none: a cache pays only where many rays meet what others have traced, "
                  "and an order of the rays speeds up tracing by itself."},
          {.name = "key",
           .slot = c(&CacheConfig::key),
           .doc = "Which rays share an entry. quantised: those that leave one primitive into one cell of directions, "
                  "wherever they leave it, so results are approximate, and chance decides which of two like rays "
                  "answers for both. exact: the same ray alone, bit for bit, so the paths are those of no cache, but "
                  "only a transmitter that stands and launches its directions again is answered; division, purge and "
                  "hit_point have no effect."},
          {.name = "hash_method",
           .slot = c(&CacheConfig::hash_method),
           .range = {1, 3},
           .doc = "Where a key lies in the table. 1 uniform: evenly spread. 2 Morton: like rays near each other, so "
                  "their entries share cache lines, but most buckets stay empty, and few segments find a place in any "
                  "but a chained table. 3 mixed: the sum of both."},
          {.name = "division",
           .slot = c(&CacheConfig::division),
           .unit = "cells a direction component",
           .range = {1, 2097151},
           .doc = "Of key = \"quantised\". Fewer cells answer more rays and err more: a result is that of a ray up to "
                  "2 / division away in each component, and from elsewhere on the primitive. 200000, as in the "
                  "thesis."},
          {.name = "buffer_size",
           .slot = c(&CacheConfig::buffer_size),
           .unit = "entries",
           .range = {16, 2147483648.0},
           .doc = "Room of the table, 64 bytes an entry and some for finding it, shared evenly by the transmitters. "
                  "Where it is too small, segments are dropped or overwritten and traced again, which costs time and "
                  "no paths."},
          {.name = "load_factor",
           .slot = c(&CacheConfig::load_factor),
           .unit = "entries a bucket",
           .range = {1, 64},
           .doc = "Of kind = \"chained\", on average in a full table. More entries share a bucket: less memory, deeper "
                  "trees. 3, as in the thesis."},
          {.name = "locking",
           .slot = c(&CacheConfig::locking),
           .doc = "Of kind = \"open\". mutex: one ray at a time has an entry; who comes meanwhile misses. readers: "
                  "the thesis' locks for reading and writing in one, and an entry wears out after readers_number "
                  "reads."},
          {.name = "readers_number",
           .slot = c(&CacheConfig::readers_number),
           .unit = "reads",
           .range = {1, 65535},
           .doc = "Of locking = \"readers\": an entry that was read so often misses until it is traced and written "
                  "anew. More reads save more, and keep an older result longer. 5, as in the thesis."},
          {.name = "purge",
           .slot = c(&CacheConfig::purge),
           .doc = "What a moving transmitter makes stale, of key = \"quantised\". position: all its entries, when it "
                  "enters another cell of position_step_m. precision: an entry whose ray was farther than "
                  "residual_value from the one that asks; keeps more of a drive and tests every answer."},
          {.name = "position_step_m",
           .slot = c(&CacheConfig::position_step_m),
           .unit = "m",
           .range = {0.001, 1000},
           .doc = "Of purge = \"position\": side of the cells of the transmitter's position. With scope = \"all\": how "
                  "far a vehicle may move until entries on it are stale. Larger steps keep entries "
                  "for more frames, with results of where things were."},
          {.name = "residual_value",
           .slot = c(&CacheConfig::residual_value),
           .unit = "m + 1, L1",
           .range = {0, 1e6},
           .doc = "Of purge = \"precision\": the largest sum of the differences of origin (m) and direction, six "
                  "components, between the ray that asks and the one that was traced. Larger answers more and errs "
                  "more. 0.0125, as in the thesis."},
          {.name = "scope",
           .slot = c(&CacheConfig::scope),
           .doc = "What an entry decides. static: what the static scene does; vehicles and receivers are tested "
                  "against every segment, so none that moves is missed. all: vehicles and receivers too, as in the "
                  "thesis; saves those tests, and overlooks who has moved into a segment since it was traced."},
          {.name = "hit_point",
           .slot = c(&CacheConfig::hit_point),
           .doc = "Where an answered ray of key = \"quantised\" goes on. own: where its line meets the plane of the "
                  "cached surface, and it is traced if that is beside the surface. cached: in the point of the other "
                  "ray, as in the thesis; saves a few operations and adds up errors along the path."},
          {.name = "first_depth",
           .slot = c(&CacheConfig::first_depth),
           .unit = "segments of a ray, counted from 1",
           .range = {1, 32},
           .doc = "Segments before this one are always traced: neighbours are launched side by side, so that the first "
                  "ones gain least from a table. 1: all are looked up."},
          {.name = "statistics",
           .slot = c(&CacheConfig::statistics),
           .doc = "Count the hits of each entry, and how often a path follows the links of an earlier one, for "
                  "summary.json. false: it costs an atomic operation a hit."},
      }};
}

}  // namespace wavetracer::config
