// SPDX-License-Identifier: Apache-2.0
// See kept_beams.cpp for what outlives a discovery. All apertures of a depth are looked through, then those of the
// next. Apertures come in blocks whose candidates fit into their list.
#include "simulation/beam_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/device/moving.h"

namespace wavetracer {
namespace {

constexpr uint32_t most_chunks = 1 << 17;         // in one block
constexpr uint32_t apertures_together = 1 << 15;  // in one block
constexpr uint32_t least_apertures = 1 << 12;

// The box of all places; without any it holds nothing, and every length is too large.
void set_box(std::span<const glm::dvec3> places, wt_floor& floor) {
  for (int axis = 0; axis < 3; ++axis) {
    floor.low[axis] = std::numeric_limits<double>::infinity();
    floor.high[axis] = -floor.low[axis];
    for (const glm::dvec3& place : places) {
      floor.low[axis] = std::min(floor.low[axis], place[axis]);
      floor.high[axis] = std::max(floor.high[axis], place[axis]);
    }
  }
}

// The length of a path that has the least gain that is followed, if it loses nothing at mirrors, m.
double reach_m(const BeamOptions& options) {
  if (!options.floor_db) return std::numeric_limits<double>::infinity();
  return options.wavelength_m / (4 * std::numbers::pi) * std::pow(10.0, -*options.floor_db / 20);
}

double units(const uint32_t (&sum)[2]) { return sum[1] * 0x1p32 + sum[0]; }

}  // namespace

BeamMirrors make_beam_mirrors(gpu::Context& context, const BeamOptions& options) {
  return {.reflectances = context.buffer(options.mirrors.bounds, "reflectances"),
          .materials_of = context.buffer(options.mirrors.materials_of, "materials of surfaces"),
          .floor = {.low = {}, .high = {}, .reach_m = reach_m(options)}};
}

BeamTracing::BeamTracing(gpu::Context& context, const Scene& scene, const std::vector<Scene>& models,
                         const BeamOptions& options, const FrameWatch* watch)
    : context_(context),
      options_(options),
      watch_(watch),
      facets_(scene, models),
      tree_(context, facets_.fixed()),
      lists_(context),
      mirrors_(make_beam_mirrors(context, options)) {}

std::vector<wt_aperture> beam_roots(std::span<const Launcher> ends) {
  std::vector<wt_aperture> roots;
  for (const Launcher& end : ends) {
    wt_aperture root{};
    for (int axis = 0; axis < 3; ++axis) root.image[axis] = end.position_m[axis];
    root.count = 4;
    root.node = WT_ROOT | end.transmitter;
    root.surface = WT_NONE;
    root.kept = 1.0f;
    root.own = end.source == WT_NONE ? WT_NONE : end.source & ~WT_OWN;
    for (const double sign : {-1.0, 1.0})
      for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
          double* at = root.corners + 3 * corner;
          std::ranges::copy(root.image, at);
          at[axis] += sign;
          at[(axis + 1) % 3] += corner == 0 || corner == 3 ? -1.0 : 1.0;
          at[(axis + 2) % 3] += corner < 2 ? -1.0 : 1.0;
        }
        roots.push_back(root);
      }
  }
  return roots;
}

uint32_t BeamTracing::start(const std::vector<wt_aperture>& roots, const wt_beam_counters& counters) {
  if (lists_.apertures.size() < std::max<size_t>(roots.size(), 1))
    lists_.apertures =
        context_.buffer<wt_aperture>(std::max<size_t>(roots.size(), least_apertures), {"apertures", advice::beams});
  lists_.apertures.write(roots, 0, Stage::beam_gather);
  if (lists_.next.size() == 0)
    lists_.next = context_.buffer<wt_aperture>(least_apertures, {"apertures", advice::beams});
  lists_.counters.write(std::vector{counters}, 0, Stage::beam_gather);
  return static_cast<uint32_t>(roots.size());
}

// Kernels are made for a few depths, so that worlds of similar size share them.
void BeamTracing::set_world(const std::vector<Instance>& instances, std::span<const Placement> placements) {
  const WorldFacets::Moving moving = facets_.moving(instances, placements);
  tree_.place(moving.facets);
  if (!moving_ && !instances.empty()) moving_.emplace(context_);
  if (moving_) moving_->place(moving.boxes);
  const uint32_t depth = tree_.tree().depth;
  if (gather_ && depth <= depth_) return;
  depth_ = (depth + 7) / 8 * 8;
  gather_.emplace(context_, depth_);
  if (!visible_) visible_.emplace(context_);
  if (!unite_) unite_.emplace(context_);
}

// The set grows by parts of it being found anew, which is rare.
BeamCounts BeamTracing::find(const DeviceScene& scene, const BeamTask& task, Sequences& set) {
  set_box(task.receivers, mirrors_.floor);
  counts_ = {};
  counts_.ends = task.standing.size() + task.moving.size();
  counts_.edges = options_.max_diffractions;
  counts_.floor_db = options_.floor_db;
  counts_.depth = task.max_depth;
  while (!try_find(scene, task, set)) {
    kept_.reset();  // nodes have moved
    set.regrow(task.max_depth);
    set.clear();
  }
  if (!task.keep) kept_.reset();
  if (watch_) watch_->tell("rays", task.max_depth, task.max_depth);
  const wt_beam_counters end = lists_.counters.read_one(0, Stage::beam_visible);
  counts_.left_out_sr = units(end.left_out) * WT_SR_UNIT;
  counts_.thin_sr = units(end.thin) * WT_SR_UNIT;
  counts_.weak_sr = units(end.weak) * WT_WEAK_SR_UNIT;
  return counts_;
}

bool BeamTracing::try_find(const DeviceScene& scene, const BeamTask& task, Sequences& set) {
  const bool sees_moving = tree_.tree().has_moving;
  std::vector<Launcher> others = task.moving;
  bool apart = !task.standing.empty() && (sees_moving || task.keep);
  if (apart) {
    if (!find_static(scene, task, key_of(task), set)) return false;
    apart = kept_ != nullptr;
  }
  if (!apart) std::ranges::copy(task.standing, std::back_inserter(others));
  const uint32_t apertures = start(beam_roots(others), apart ? kept_->counters : wt_beam_counters{});
  counts_.any_depth = apart;
  const Walk walk{.root = tree_.tree().root(), .from = apart && sees_moving ? kept_.get() : nullptr};
  if (!follow(scene, task, apertures, walk, set, counts_.any_depth)) return false;
  counts_.any_depth = counts_.any_depth && (!apart || kept_->any_depth);
  return true;
}

bool BeamTracing::follow(const DeviceScene& scene, const BeamTask& task, uint32_t apertures, const Walk& walk,
                         Sequences& set, bool& any_depth) {
  for (uint32_t depth = 1; depth <= task.max_depth; ++depth) {
    if (watch_) watch_->tell("rays", depth - 1, task.max_depth);
    // Each wall that a wave passes also counts as an interaction.
    const uint32_t walls = std::min(options_.max_transmissions, task.max_depth - depth);
    const bool more = walk.from && depth <= walk.from->depths.size();
    if (more) apertures = (*moving_)(scene, walk.from->depths[depth - 1], lists_, apertures, walls);
    if (apertures == 0 && more) continue;
    if (apertures == 0) break;
    // The last depth makes no apertures, and a beam that passes fewer walls than it might may meet more behind them.
    any_depth = depth < task.max_depth && walls == options_.max_transmissions;
    BeamStep step{.depth = depth,
                  .max_depth = task.max_depth,
                  .walls = walls,
                  .edges = options_.max_diffractions > 0,
                  .root = walk.root};
    KeptApertures kept;
    if (walk.into) {
      kept = {.apertures = context_.buffer<wt_aperture>(apertures, {"apertures that are kept", advice::beams}),
              .outlooks = context_.buffer<wt_outlook>(apertures, {"outlooks", advice::beams}),
              .count = apertures};
      if (walk.into->bytes() + kept.bytes() > limit_bytes())
        throw gpu::BufferError("beams that are kept need more memory than they may have");
      step.outlooks = &kept.outlooks;
      context_.copy(lists_.apertures, kept.apertures, apertures * sizeof(wt_aperture), Stage::beam_gather);
    }
    if (!look(scene, apertures, step, set)) return false;
    if (walk.into) walk.into->depths.push_back(std::move(kept));
    apertures = lists_.counters.read_one(0, Stage::beam_visible).apertures;
    if (apertures > 0) apertures = (*unite_)(scene, lists_, apertures, set.trie());
  }
  return true;
}

bool BeamTracing::look(const DeviceScene& scene, uint32_t apertures, const BeamStep& step, Sequences& set) {
  uint32_t block = 0;  // its first aperture
  const auto list = [&](uint32_t first, uint32_t end) {
    block = first;
    return (*gather_)(tree_.tree(), scene, lists_, first, end - first, step, most_chunks);
  };
  const auto take = [&](uint32_t chunks) {
    if (watch_) watch_->tell("rays", step.depth - 1, step.max_depth);  // between blocks a frame may be stopped
    (*visible_)(tree_.tree(), scene, mirrors_, lists_, block, chunks, step, set.trie());
  };
  const auto too_long = [](uint32_t) {
    throw gpu::BufferError(
        "one aperture has more facets in its beam than a list holds: a scene of so many triangles "
        "needs trace.discovery = \"rays\"");
  };
  by_parts(
      apertures, apertures_together, most_chunks, list, take, [](uint32_t) {}, too_long);
  return lists_.counters.read_one(0, Stage::beam_visible).trie_overflow == 0;
}

}  // namespace wavetracer
