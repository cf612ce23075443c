// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/sequences.cl.
// The table starts small: a million rays in a city leave a few thousand sequences.
#include "passes/sequences.hpp"

#include <numeric>

#include "passes/growing_list.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Sequences::Sequences(gpu::Context& context, uint64_t slots, bool keep_ages)
    : context_(context),
      keep_ages_(keep_ages),
      slots_work_(tuning_of(context.info()).slots),
      work_(tuning_of(context.info()).sequences),
      nodes_(context.buffer<uint32_t>(4096, "sequence list")),
      counters_(context) {
  gpu::Definitions definitions = {{"WT_SLOTS_PER_ITEM", slots_work_.option()}};
  if (keep_ages) definitions["WT_AGES"] = "1";
  clear_ = {context, definitions};
  collect_ = {context, definitions};
  commute_ = {context, definitions};
  regrow_ = {context, definitions};
  follow_ = {context, definitions};
  keep_ = {context, definitions};
  resize(slots);
}

void Sequences::resize(uint64_t slots) {
  quarters_ = context_.buffer<uint32_t>(slots, "quarters of sequences");
  if (keep_ages_) {
    ages_ = context_.buffer<uint32_t>(slots, "ages of sequences");
    context_.fill(ages_, 0, Stage::sequences);
  }
  table_ = context_.buffer<uint64_t>(slots, "sequences");  // last, since its size is the number of slots
  clear();
}

Counters::Zeroed Sequences::clear() {
  clear_(slots_work_.range(table_.size()), Stage::sequences,
         calls::sequences::clear{.table = table_,
                                 .quarters = quarters_,
                                 .slots = static_cast<uint32_t>(table_.size()),
                                 .counters = counters_.buffer()});
  return {};
}

gpu::Buffer<uint32_t> Sequences::rebuild(uint64_t slots, uint32_t max_depth, uint32_t oldest) {
  const gpu::Buffer<uint64_t> old_table = table_;
  const gpu::Buffer<uint32_t> old_quarters = quarters_, old_ages = ages_;
  gpu::Buffer<uint32_t> moved = context_.buffer<uint32_t>(old_table.size(), "moved sequences");
  for (;; slots *= 4) {
    // This is checked at every step: a slot must leave the bits of WT_ROOT and of a ray's quarter free.
    if (slots > uint64_t{1} << WT_QUARTER_SHIFT)
      throw RuntimeError("the set of distinct sequences has outgrown 2^29 slots; lower trace.rays or trace.max_depth");
    resize(slots);
    for (uint32_t depth = 1; depth <= max_depth; ++depth)
      regrow_(work_.range(old_table.size()), Stage::sequences,
              calls::sequences::regrow{.old_table = old_table,
                                       .old_slots = static_cast<uint32_t>(old_table.size()),
                                       .depth = depth,
                                       .moved = moved,
                                       .table = table_,
                                       .mask = static_cast<uint32_t>(table_.size() - 1),
                                       .old_quarters = old_quarters,
                                       .quarters = quarters_,
                                       .counters = counters_.buffer(),
                                       .old_ages = keep_ages_ ? &old_ages : nullptr,
                                       .ages = ages(),
                                       .oldest = oldest});
    if (!overflowed()) return moved;
  }
}

void Sequences::regrow(uint32_t max_depth, uint32_t listed_count) {
  const gpu::Buffer<uint32_t> moved = rebuild(table_.size() * 4, max_depth, 0);
  if (listed_count > 0)
    follow_(work_.range(listed_count), Stage::sequences,
            calls::sequences::follow{.nodes = nodes_, .node_count = listed_count, .moved = moved});
}

void Sequences::forget(uint32_t frames, uint32_t max_depth) {
  if (keep_ages_ && frame_ > frames) rebuild(table_.size(), max_depth, 2 * (frame_ - frames));
}

void Sequences::keep(const SolvedList& solved) {
  if (!keep_ages_ || solved.count == 0) return;
  keep_(work_.range(solved.count), Stage::sequences,
        calls::sequences::keep{.table = table_,
                               .solved = solved.headers,
                               .solved_count = solved.count,
                               .solved_counter = solved.counter,
                               .counters = counters_.buffer(),
                               .ages = ages_,
                               .now = now()});
}

void Sequences::commute(const gpu::Buffer<wt_surface>& surfaces, const Found& found) {
  const uint32_t lanes = tuning_of(context_.info()).exchange_lanes(found.node_count);
  commute_(work_.range(size_t{found.node_count} * lanes), Stage::sequences,
           calls::sequences::commute{.table = found.trie.table,
                                     .mask = static_cast<uint32_t>(found.trie.table.size() - 1),
                                     .nodes = found.nodes,
                                     .node_count = found.node_count,
                                     .capacity = static_cast<uint32_t>(found.nodes.size()),
                                     .surfaces = surfaces,
                                     .quarters = found.trie.quarters,
                                     .counters = found.trie.counters.buffer(),
                                     .ages = found.trie.ages,
                                     .now = found.trie.now,
                                     .lanes = lanes});
}

uint32_t Sequences::extend(uint32_t node_count, uint32_t max_depth, const std::function<void(const Found&)>& enter) {
  const size_t room = nodes_.size() - node_count;
  for (bool grew = false;; grew = true) {
    enter({trie(), nodes_, node_count});
    const uint32_t added = counters_.length(&wt_counters::exchanged, room, Stage::sequences);
    if (counters_.foresees()) return node_count + added;
    if (!overflowed()) return grew || added > room ? collect(roots_) : node_count + added;
    // This runs again with the same nodes: sequences that were entered for others that were just entered would make the
    // set depend on when its table was full.
    regrow(max_depth, node_count);
    counters_.restart_nodes(node_count, Stage::sequences);
  }
}

void Sequences::write_roots(uint32_t transmitter_count) {
  if (roots_ == transmitter_count) return;
  if (nodes_.size() < transmitter_count)
    nodes_ = context_.buffer<uint32_t>(4 * size_t{transmitter_count}, "sequence list");
  std::vector<uint32_t> roots(transmitter_count);
  std::iota(roots.begin(), roots.end(), WT_ROOT);
  nodes_.write(roots, 0, Stage::sequences);
  roots_ = transmitter_count;
}

uint32_t Sequences::collect(uint32_t transmitter_count) {
  const auto reserve = [&](size_t entries) {
    nodes_ = context_.buffer<uint32_t>(entries, "sequence list");
    roots_ = 0;
  };
  const size_t wanted = counters_.expected(&wt_counters::nodes) + counters_.expected(&wt_counters::exchanged);
  if (counters_.foresees() && wanted > nodes_.size()) reserve(wanted);
  return grow_until_filled(
      [&] {
        write_roots(transmitter_count);
        counters_.restart_nodes(transmitter_count, Stage::sequences);
        collect_(slots_work_.range(table_.size()), Stage::sequences,
                 calls::sequences::collect{.table = table_,
                                           .slots = static_cast<uint32_t>(table_.size()),
                                           .nodes = nodes_,
                                           .capacity = static_cast<uint32_t>(nodes_.size()),
                                           .counters = counters_.buffer()});
      },
      [&] { return counters_.length(&wt_counters::nodes, nodes_.size(), Stage::sequences); },
      [&] { return nodes_.size(); }, reserve);
}

}  // namespace wavetracer
