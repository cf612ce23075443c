// SPDX-License-Identifier: Apache-2.0
// Makes sets of sequences on the device without tracing, and runs the exact half of a frame (candidates, solve,
// occlusion). Sequences enter through the interact pass, as rays do: with hit lists that a test writes itself.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "passes/candidates.hpp"
#include "passes/interact.hpp"
#include "passes/occlusion.hpp"
#include "passes/on_device.hpp"
#include "passes/scan.hpp"
#include "passes/sequences.hpp"
#include "passes/solve.hpp"

namespace wavetracer::test {

struct Sequence {
  uint32_t transmitter = 0;
  std::vector<uint32_t> surfaces;
  auto operator<=>(const Sequence&) const = default;
};
using SequenceSet = std::set<Sequence>;

// Returns the required content of the trie: every sequence with all its beginnings, except the empty one.
inline SequenceSet with_prefixes(const std::vector<Sequence>& sequences) {
  SequenceSet out;
  for (Sequence s : sequences)
    for (; !s.surfaces.empty(); s.surfaces.pop_back()) out.insert(s);
  return out;
}

// Makes a hit list in which ray i hits surface surfaces[i] or nothing (WT_NONE), at distance 1. rays: its capacity, at
// least the number of surfaces; the planes of a queue and its hits must have one length.
inline HitList upload_hits(const std::vector<uint32_t>& surfaces, size_t rays) {
  const uint32_t block = tuning_of(context().info()).block;
  HitList hits = make_hit_list(context(), rays);
  std::vector<float> planes(hits.planes.size(), 1.0f);
  std::vector<uint32_t> counts(hits.block_hits.size(), 0);
  for (size_t i = 0; i < surfaces.size(); ++i) {
    planes[size_t{WT_HIT_PRIMITIVE} * hits.capacity + i] = std::bit_cast<float>(surfaces[i]);
    planes[size_t{WT_HIT_SURFACE} * hits.capacity + i] = std::bit_cast<float>(surfaces[i]);
    counts[i / block] += surfaces[i] != WT_NONE;
  }
  hits.planes.write(planes);
  hits.block_hits.write(counts);
  return hits;
}

// Sends rays through these sequences once, one ray per sequence. A full table is not grown.
inline void enter_once(Sequences& set, const DeviceScene& scene, std::vector<Sequence> sequences) {
  Scan scan(context());
  Interact interact(context());
  std::vector<Ray> rays;
  for (const Sequence& s : sequences) rays.push_back({{}, {1, 0, 0}, WT_NONE, WT_ROOT | s.transmitter});
  RayQueue queue = upload(rays), next = upload(rays);
  for (size_t depth = 0; queue.count > 0; ++depth) {
    std::vector<uint32_t> surfaces;
    for (const Sequence& s : sequences) surfaces.push_back(depth < s.surfaces.size() ? s.surfaces[depth] : WT_NONE);
    std::erase_if(sequences, [&](const Sequence& s) { return s.surfaces.size() <= depth; });
    HitList hits = upload_hits(surfaces, rays.size());
    const uint32_t alive = scan(hits.block_hits, hits.blocks(queue.count));
    interact(scene, queue, hits, alive, set.trie(), {.reflected = &next});
    std::swap(queue, next);
  }
}

// Does the same, and grows the set until all of them are in it, as Discovery does with a batch.
inline void enter(Sequences& set, const DeviceScene& scene, const std::vector<Sequence>& sequences,
                  uint32_t max_depth) {
  for (enter_once(set, scene, sequences); set.overflowed(); enter_once(set, scene, sequences)) set.regrow(max_depth);
}

// Returns every sequence of the set, or nothing if a chain does not end in one of the roots or a node is listed twice.
inline std::optional<SequenceSet> contents(Sequences& set, uint32_t transmitter_count) {
  const uint32_t count = set.collect(transmitter_count);
  const std::vector<uint32_t> nodes = set.nodes().read(0, count);
  const std::vector<uint64_t> table = set.table().read();
  SequenceSet out;
  for (uint32_t i = 0; i < count; ++i) {
    if (i < transmitter_count) {
      if (nodes[i] != (WT_ROOT | i)) return std::nullopt;
      continue;
    }
    Sequence s;
    uint32_t node = nodes[i];
    while (!(node & WT_ROOT)) {
      if (node >= table.size() || table[node] == WT_EMPTY || s.surfaces.size() > WT_MAX_DEPTH) return std::nullopt;
      s.surfaces.push_back(static_cast<uint32_t>(table[node]));
      node = static_cast<uint32_t>(table[node] >> 32);
    }
    std::reverse(s.surfaces.begin(), s.surfaces.end());
    s.transmitter = node & ~WT_ROOT;
    if (s.transmitter >= transmitter_count || !out.insert(s).second) return std::nullopt;
  }
  return out;
}

struct SolvedPath {
  Sequence sequence;
  uint32_t receiver = 0;
  std::vector<glm::dvec3> points;
  bool blocked = false;
};

// Returns fixed ends on no vehicle, all of them linked.
inline RadioEnds standing_ends(const std::vector<glm::dvec3>& transmitters, const std::vector<glm::dvec3>& receivers) {
  std::vector<EndState> tx(transmitters.size()), rx(receivers.size());
  std::vector<Link> links;
  for (size_t i = 0; i < tx.size(); ++i) tx[i].position_m = transmitters[i];
  for (size_t i = 0; i < rx.size(); ++i) rx[i].position_m = receivers[i];
  for (uint32_t t = 0; t < tx.size(); ++t)
    for (uint32_t r = 0; r < rx.size(); ++r) links.push_back({t, r});
  return make_radio_ends(context(), tx, rx, links);
}

// The exact half of a frame. Candidates are listed as (sequence, receiver), the empty sequence for a line of sight.
struct Exact {
  std::set<std::pair<Sequence, uint32_t>> candidates;
  uint32_t candidate_count = 0;
  std::vector<SolvedPath> solved;  // sorted by sequence, then receiver

  Exact(
      const Scene& scene, const std::vector<glm::dvec3>& transmitters, const std::vector<glm::dvec3>& receivers,
      const std::vector<Sequence>& sequences, uint32_t max_depth,
      const std::function<void(DeviceScene&)>& add_instances = [](DeviceScene&) {}) {
    double reach_m = 0;
    for (const auto& ends : {transmitters, receivers})
      for (const glm::dvec3& p : ends) reach_m = std::max({reach_m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    DeviceScene uploaded = make_device_scene(context(), scene, false, reach_m);
    add_instances(uploaded);
    const RadioEnds ends = standing_ends(transmitters, receivers);
    Sequences set(context(), 4096);
    enter(set, uploaded, sequences, max_depth);
    const uint32_t node_count = set.collect(ends.transmitter_count);
    Candidates find(context());
    candidate_count = find(uploaded, ends, set.table(), set.nodes(), node_count, set.counters());
    const std::vector<uint64_t> table = set.table().read();
    for (const wt_candidate& c : find.list().read(0, candidate_count)) {
      Sequence s;
      uint32_t node = c.node;
      for (; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
        s.surfaces.insert(s.surfaces.begin(), static_cast<uint32_t>(table[node]));
      s.transmitter = node & ~WT_ROOT;
      candidates.emplace(s, c.receiver);
    }
    Solve solve(context(), max_depth);
    SolvedList& list = solve(uploaded, ends, set.table(), set.quarters(), find.list(), candidate_count, set.counters());
    Occlusion occlusion(context(), uploaded);
    if (list.count > 0) occlusion(uploaded, ends, list, set.counters());
    read(list);
  }

  size_t visible() const {
    return static_cast<size_t>(
        std::count_if(solved.begin(), solved.end(), [](const SolvedPath& p) { return !p.blocked; }));
  }

 private:
  void read(const SolvedList& list) {
    if (list.count == 0) return;
    const std::vector<wt_solved> headers = list.headers.read(0, list.count);
    const std::vector<uint32_t> surfaces = list.sequences.read(0, size_t{list.count} * list.max_depth);
    const std::vector<double> xyz = list.vertices.read(0, 3 * surfaces.size());
    for (size_t i = 0; i < headers.size(); ++i) {
      SolvedPath path{{headers[i].transmitter, {}}, headers[i].receiver, {}, headers[i].blocked != 0};
      for (size_t k = i * list.max_depth; k < i * list.max_depth + headers[i].depth; ++k) {
        path.sequence.surfaces.push_back(surfaces[k]);
        path.points.emplace_back(xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]);
      }
      solved.push_back(path);
    }
    std::sort(solved.begin(), solved.end(), [](const SolvedPath& a, const SolvedPath& b) {
      return std::tie(a.sequence, a.receiver) < std::tie(b.sequence, b.receiver);
    });
  }
};

// All sequences of max_depth surfaces, none of which follows itself; their prefixes are all the shorter ones.
inline std::vector<Sequence> all_sequences(uint32_t transmitter_count, uint32_t surface_count, uint32_t max_depth) {
  std::vector<Sequence> longest;
  for (uint32_t t = 0; t < transmitter_count; ++t) longest.push_back({t, {}});
  for (uint32_t depth = 0; depth < max_depth; ++depth) {
    std::vector<Sequence> longer;
    for (const Sequence& s : longest)
      for (uint32_t surface = 0; surface < surface_count; ++surface) {
        if (!s.surfaces.empty() && s.surfaces.back() == surface) continue;
        longer.push_back(s);
        longer.back().surfaces.push_back(surface);
      }
    longest = longer;
  }
  return longest;
}

}  // namespace wavetracer::test
