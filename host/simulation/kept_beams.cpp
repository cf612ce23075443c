// SPDX-License-Identifier: Apache-2.0
// The beams of ends that stand over surfaces that do not move: they are followed once, and kept as long as these ends
// stay and memory lasts. The set of sequences is kept as its table, so that the slots that apertures name stay theirs.
#include <algorithm>
#include <cstring>

#include "passes/advice.hpp"
#include "simulation/beam_tracing.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t share_of_memory = 4;

}  // namespace

// Records of the device have no padding that is not written.
bool BeamTracing::Key::operator==(const Key& other) const {
  return max_depth == other.max_depth && roots.size() == other.roots.size() &&
         std::memcmp(&floor, &other.floor, sizeof floor) == 0 &&
         std::memcmp(roots.data(), other.roots.data(), roots.size() * sizeof(wt_aperture)) == 0;
}

uint64_t BeamTracing::Kept::bytes() const {
  uint64_t out = table.bytes() + quarters.bytes();
  for (const KeptApertures& depth : depths) out += depth.bytes();
  return out;
}

uint64_t BeamTracing::limit_bytes() const {
  return options_.most_kept_bytes.value_or(context_.info().global_memory / share_of_memory);
}

std::string BeamTracing::keep_nothing() {
  kept_.reset();
  options_.most_kept_bytes = 0;
  return "a frame lacked memory on the device while the beams of ends that stand were kept: they are dropped, and this "
         "frame and later ones follow them anew, which finds the same paths and takes longer";
}

// Receivers count only where paths may be too weak to reach them.
BeamTracing::Key BeamTracing::key_of(const BeamTask& task) const {
  return {.roots = beam_roots(task.standing),
          .floor = options_.floor_db ? mirrors_.floor : wt_floor{},
          .max_depth = task.max_depth};
}

bool BeamTracing::restore(const Key& key, Sequences& set) {
  if (!kept_ || !kept_->table || !(kept_->key == key) || kept_->table.size() != set.table().size()) return false;
  context_.copy(kept_->table, set.table(), kept_->table.bytes(), Stage::beam_gather);
  context_.copy(kept_->quarters, set.quarters(), kept_->quarters.bytes(), Stage::beam_gather);
  return true;
}

bool BeamTracing::find_static(const DeviceScene& scene, const BeamTask& task, Key key, Sequences& set) {
  if (restore(key, set)) return true;
  kept_.reset();
  if (limit_bytes() == 0) return true;
  if (too_large_ && *too_large_ == key) return true;
  auto kept = std::make_unique<Kept>(Kept{.key = key});
  try {
    const Walk walk{.root = BeamTree::fixed_root, .into = moving_ ? kept.get() : nullptr};
    if (!follow(scene, task, start(key.roots, {}), walk, set, kept->any_depth)) return false;
    kept->counters = lists_.counters.read_one(0, Stage::beam_visible);
    if (task.keep) {
      kept->table = context_.buffer<uint64_t>(set.table().size(), {"sequences that are kept", advice::beams});
      kept->quarters = context_.buffer<uint32_t>(set.quarters().size(), {"sequences that are kept", advice::beams});
      if (kept->bytes() > limit_bytes())
        throw gpu::BufferError("beams that are kept need more memory than they may have");
      context_.copy(set.table(), kept->table, kept->table.bytes(), Stage::beam_gather);
      context_.copy(set.quarters(), kept->quarters, kept->quarters.bytes(), Stage::beam_gather);
    }
    kept_ = std::move(kept);
  } catch (const gpu::BufferError&) {
    // All ends are followed with the others then, in every discovery. That takes longer, and what vehicles hide as a
    // whole is left out, which no path needs.
    too_large_ = std::move(key);
    set.clear();
  }
  return true;
}

}  // namespace wavetracer
