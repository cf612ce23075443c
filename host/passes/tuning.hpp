// SPDX-License-Identifier: Apache-2.0
// One table that says how kernels are launched: every choice between CPUs and GPUs that changes time and no result. A
// comment with figures says where they were measured; rows without one were chosen by reasoning and not measured.
// bench_kernels, bench_sort, bench_trace and bench_cache show the effect of a changed row. Passes whose work-items do
// little for one element, on every device, need no row: their groups are DeviceInfo::simple_local_size().
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include "gpu/gpu.hpp"

namespace wavetracer {

// The division of a launch's elements (rays, words, rows) among work-items.
struct Work {
  uint32_t per_item = 1;  // elements that a work-item takes one after the other
  uint32_t group = 1;     // work-items per group

  // The work-items for this many elements; the last one may have fewer.
  gpu::Range range(size_t elements) const { return {(elements + per_item - 1) / per_item, group}; }
  // per_item in the form of a kernel's build option.
  std::string option() const { return std::to_string(per_item) + "u"; }
};

// The way prefix sums are made: `items` work-items per chunk (a power of two); one chunk for at most `alone` counts,
// else about `chunks` of them, at most ScanTuning::most_chunks.
struct ScanTuning {
  static constexpr uint32_t most_chunks = 1024;
  uint32_t items, alone, chunks;
};

// The launches of bitonic_sort.
struct BitonicTuning {
  uint32_t items;       // the most work-items per block of keys
  uint32_t step_group;  // work-items per group of the steps over all keys
};

// The way radix_sort ranks the keys of a tile (lib/radix_rank.clh); the result is the same. votes and match are
// instructions of NVIDIA's GPUs, on other devices they are masks.
enum class RadixRanks { columns, masks, votes, match };

inline bool on_nvidia(const gpu::DeviceInfo& device) { return device.platform.find("NVIDIA") != std::string::npos; }

// The launches of radix_sort by groups.
struct RadixTuning {
  uint32_t digit_bits = 8;  // bits of the widest digit
  uint32_t items = 256;     // items per group; a multiple of 32
  uint32_t item_keys = 18;  // keys of an item; a group's are its tile
  RadixRanks ranks = RadixRanks::columns;
  uint32_t columns = 0;      // columns of a tile, an even number, at most `items` (RadixRanks::columns only)
  bool late_values = false;  // values are read after the tile is ranked
  uint32_t window = 4;       // earlier tiles that are looked at together
  uint32_t looks = 1000;     // after this many looks in vain a group counts an earlier tile itself
  uint32_t registers = 0;    // the most of an item, on NVIDIA's GPUs; 0: the compiler's choice
  uint32_t silent = 0;       // for tests: every tile whose number is a multiple of it publishes nothing; 0: none is
  uint32_t most_keys = 1u << 29;                    // the most keys of a launch, fewer than 2^30
  uint32_t count_items = 256, count_groups = 1056;  // those of the kernel that counts: items per group, most groups
  bool tickets = true;  // a group takes the next tile, which others have begun in order; else that of its number

  uint32_t tile() const { return items * item_keys; }
};

// The launches of radix_sort by single work-items.
struct RadixChunks {
  uint32_t digit_bits;  // bits of the widest digit
  uint32_t tile;        // a chunk is a multiple of this many keys
  uint32_t most_chunks;
  uint64_t direct_bytes;  // up to this many bytes of keys and values are written without lines
};

struct Tuning {
  bool alone;  // work-items take runs of elements by themselves (CPUs); else groups take blocks together

  uint32_t block;            // rays per block: the unit in which hits are counted and rays are compacted
  uint32_t blocks_per_item;  // blocks that an item of interact and compact takes in turn, if alone
  Work blocks;               // interact and compact: elements are the rays or words

  Work generate_rays, order_keys, label_rays, gather_rays;
  uint32_t trace_group;  // work-items per group where one takes a block
  Work trace_moving, bounces;
  Work cache_rays, cache_entries;  // cache_lookup and cache_store; cache_purge
  Work receive;                    // also edge_rays and hear

  Work slots;  // collect: slots of the table of sequences
  Work sequences;
  uint32_t busy_nodes;  // commute: nodes that keep the device busy
  Work candidates, exact, prefixes;
  uint32_t join_lanes, join_group;          // wedge_join: work-items per prefix
  uint32_t pairs_lanes, pairs_group;        // wedge_pairs: work-items per group of prefixes
  Work tiles;                               // rows of scatter
  Work points;                              // point_prefixes: tiles that an end tries by a chain of mirrors
  uint32_t onlooker_lanes;                  // onlookers: work-items per node
  uint32_t gather_lanes;                    // beam_gather: work-items per aperture
  uint32_t visible_lanes, visible_targets;  // beam_visible: work-items per group, candidates that a group takes in turn

  // The work-items per node that commute takes: each exchange waits for memory several times in a row.
  uint32_t exchange_lanes(uint32_t nodes) const { return nodes < busy_nodes ? 4 : 1; }

  ScanTuning scan;
  BitonicTuning bitonic;
  uint32_t top_level_items;  // those of the one group that makes the inner boxes of the top-level tree
  uint64_t batch_rays;       // rays in flight, where configuration and memory allow it
};

// The work-items that a node of the trie takes, which share the ends of its root, at most most_ends.
inline uint32_t lanes_of_ends(const gpu::DeviceInfo& device, uint32_t most_ends) {
  return device.cpu ? 1 : std::min(most_ends, 16u);
}

inline Tuning tuning_of(const gpu::DeviceInfo& device) {
  const bool cpu = device.cpu;
  const uint32_t small = device.simple_local_size();  // DeviceInfo has its figure
  const uint32_t block = cpu ? 16 : 128;              // 16: the lanes of a packet; 128: not measured
  // This makes the work of a CPU's work-item worth its start; not measured.
  const uint32_t blocks_per_item = 64;
  const auto widest = static_cast<uint32_t>(std::bit_floor(device.max_work_group));
  return {
      .alone = cpu,
      .block = block,
      .blocks_per_item = blocks_per_item,
      .blocks = cpu ? Work{block * blocks_per_item, 4} : Work{1, block},
      // Kernels in vectors of 16 lanes on CPUs need exactly this per_item.
      .generate_rays = {cpu ? 16u : 1u, small},
      .order_keys = {cpu ? 16u : 1u, small},
      // This is a page of 4 KiB of each plane; not measured.
      .label_rays = cpu ? Work{1024, 1} : Work{1, small},
      .gather_rays = cpu ? Work{1024, 1} : Work{1, small},
      .trace_group = 16,
      .trace_moving = cpu ? Work{16, 16} : Work{1, 128},
      .bounces = {1, cpu ? 64u : 128u},
      // CPUs: sixteen searches of a run begin together (lib/prefetch.clh). The length of a run was not measured.
      .cache_rays = cpu ? Work{256, 1} : Work{1, small},
      .cache_entries = {16, small},
      .receive = {1, cpu ? 64u : 128u},
      .slots = cpu ? Work{256, 1} : Work{1, small},
      .sequences = {1, 64},
      .busy_nodes = cpu ? 0u : 1u << 16,  // not measured
      .candidates = {1, cpu ? 64u : 128u},
      // Kernels in double with long private arrays, whose neighbours take very different times, have small groups.
      // GPUs: an H200 takes 0.41 ms for the legs of 132,000 solved paths in groups of 16, 0.31 in groups of 32 to 128
      // (bench_drive, 100 vehicles, depth 3, 2026-11-24).
      .exact = {1, cpu ? 16u : 32u},
      .prefixes = {1, 64},           // the ground bounds many wedges and a wall few
      .join_lanes = cpu ? 1u : 32u,  // a wedge may be seen by few prefixes or by thousands; not measured
      // Most prefixes are not a transmitter's and end at once. GPUs: an H100 takes 0.36 ms instead of 0.52 in groups of
      // 32, for 600,000 prefixes (munich, 1 x 100, `run --repeat 60`, 2026-11-25). Pairs take long, and are few.
      .join_group = cpu ? 32u : 256u,
      // An H100 takes 1,858, 1,089 and 703 ms with 32, 64 and 128 of them (COST 231's Munich, 1 x 1,031, `wavetracer
      // run` with trace.max_diffractions = 2, 2026-11-26).
      .pairs_lanes = cpu ? 1u : 128u,
      .pairs_group = 32,
      // One search for the entry serves many rows where there are few cores.
      .tiles = {cpu ? 64u : 1u, small},
      .points = cpu ? Work{64, 1} : Work{4, 32},  // the images of a chain serve the tiles of a surface; not measured
      .onlooker_lanes = cpu ? 1u : 32u,           // an H200: 0.40 ms, and 14.6 with 1 (bench_kernels, 2026-11-29)
      .gather_lanes = cpu ? 1u : 128u,
      .visible_lanes = cpu ? 1u : 32u,
      .visible_targets = cpu ? 32u : 1u,
      // CPUs: one launch reads once, two read twice. Two free cores gain 1.07 at 2^18 counts, 1.3 at 2^20 and 2^22,
      // 1.15 at 2^24 (PoCL, medians of 80); if another program keeps one of them busy, two launches take 1.2 to 1.4
      // times as long. So two launches are used above 2^19. GPUs: not measured.
      .scan = cpu ? ScanTuning{1, 1u << 19, 4 * device.compute_units}
                  : ScanTuning{std::min(256u, widest), 4096, ScanTuning::most_chunks},
      .bitonic = {.items = std::min(1024u, widest), .step_group = 256},
      .top_level_items = std::min(1024u, widest),
      // This many rays fill the device; with few cores they also suit its caches. Not measured.
      .batch_rays = uint64_t{1} << (cpu ? 18 : 25),
  };
}

// Kernels of paths that are known.
struct PathTuning {
  uint32_t leg_registers;  // occlusion: the most of a work-item, on NVIDIA's GPUs; 0: the compiler's choice
  bool corners_apart;      // fields: paths past corners have a launch of their own, and do not hold up their neighbours
  uint32_t sum_lanes;      // link_sums: work-items of a link whose rows have waves
};

// An H200 takes these times for 4.5 million paths around edges, some of which pass corners (munich, 22,500 cells,
// `wavetracer run --repeat 5`, 2026-11-28): occlusion 7.2 ms with 80 registers, 7.4 with 64, 7.9 with 96, 9.1 without a
// limit; fields 21 ms with corners apart, 64 without; no limit of registers from 48 to 128 made fields faster.
inline PathTuning path_tuning_of(const gpu::DeviceInfo& device) {
  return {
      .leg_registers = on_nvidia(device) ? 80u : 0u, .corners_apart = !device.cpu, .sum_lanes = device.cpu ? 1u : 32u};
}

// Radix sort by groups. key_bytes, value_bytes: those of an element; value_bytes is 0 without values.
// NVIDIA's GPUs: bench_sort --variants on an H100 (2026-11-28). Others: the counters of the columns fill 48 or 32 KiB
// of local memory.
inline RadixTuning radix_groups(const gpu::DeviceInfo& device, uint32_t key_bytes, uint32_t value_bytes) {
  RadixTuning tuning;
  const bool large = device.local_memory >= 48 << 10;
  if (large && on_nvidia(device)) {
    tuning.ranks = RadixRanks::votes;
    const bool pairs = key_bytes == 4 && value_bytes > 0;
    tuning.items = pairs ? 384 : 256;
    tuning.item_keys = pairs ? 18 : 20;
    tuning.window = value_bytes == 0 ? 4 : pairs ? 2 : 1;
    tuning.late_values = value_bytes > 0;
    return tuning;
  }
  tuning.columns = large ? 72 : 32;
  tuning.item_keys = tuning.columns / 4;
  return tuning;
}

// Radix sort by single work-items. There are eight chunks per core, because PoCL hands the first thread that comes half
// of all groups (and one) at once, the next half of the rest; the last chunks even that out. Keys and values of 16 MiB
// still fit into the caches with the copy that they are moved to (measured with 32 MiB of third-level cache).
inline RadixChunks radix_chunks(const gpu::DeviceInfo& device) {
  return {.digit_bits = 8,
          .tile = 1024,
          .most_chunks = 8 * std::max(1u, device.compute_units),
          .direct_bytes = uint64_t{16} << 20};
}

// A sort of at most one block of bitonic_sort is one launch there; above it radix_sort is faster. GPUs gain more by
// fewer launches than they lose by more work, CPUs sort a block in vectors (bench_sort prints both at sizes around it).
constexpr uint32_t largest_bitonic_block = 8192;

// From this number of instances on a GPU builds the top-level tree faster than the host: an H200 places 100, 400 and
// 10,000 in 0.058, 0.065 and 0.31 ms with a tree of its own, and in 0.066, 0.20 and 4 to 6 ms with one by the host
// (bench_drive).
constexpr size_t device_tree_instances = 100;

}  // namespace wavetracer
