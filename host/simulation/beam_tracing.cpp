// SPDX-License-Identifier: Apache-2.0
// All apertures of a depth are looked through, then those of the next. Apertures come in blocks whose candidates fit
// into their list.
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
      max_transmissions_(options.max_transmissions),
      max_diffractions_(options.max_diffractions),
      floor_db_(options.floor_db),
      watch_(watch),
      facets_(scene, models),
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

uint32_t BeamTracing::start(const std::vector<Launcher>& ends) {
  const std::vector<wt_aperture> roots = beam_roots(ends);
  if (lists_.apertures.size() < roots.size())
    lists_.apertures =
        context_.buffer<wt_aperture>(std::max<size_t>(roots.size(), least_apertures), {"apertures", advice::beams});
  lists_.apertures.write(roots, 0, Stage::beam_gather);
  if (lists_.next.size() == 0)
    lists_.next = context_.buffer<wt_aperture>(least_apertures, {"apertures", advice::beams});
  lists_.counters.write(std::vector<wt_beam_counters>(1), 0, Stage::beam_gather);
  counts_ = {};
  counts_.ends = ends.size();
  counts_.edges = max_diffractions_;
  counts_.floor_db = floor_db_;
  return static_cast<uint32_t>(roots.size());
}

// Kernels are made for a few depths, so that worlds of similar size share them.
void BeamTracing::set_world(const std::vector<Instance>& instances, std::span<const Placement> placements) {
  tree_ = make_beam_tree(context_, facets_.at(instances, placements));
  if (gather_ && tree_.depth <= depth_) return;
  depth_ = (tree_.depth + 7) / 8 * 8;
  gather_.emplace(context_, depth_);
  if (!visible_) visible_.emplace(context_);
}

BeamCounts BeamTracing::find(const DeviceScene& scene, const std::vector<Launcher>& ends,
                             std::span<const glm::dvec3> receivers, uint32_t max_depth, Sequences& set) {
  set_box(receivers, mirrors_.floor);
  uint32_t apertures = start(ends);
  for (uint32_t depth = 1; depth <= max_depth && apertures > 0; ++depth) {
    if (watch_) watch_->tell("rays", depth - 1, max_depth);
    // Each wall that a wave passes also counts as an interaction.
    const uint32_t walls = std::min(max_transmissions_, max_depth - depth);
    // The last depth makes no apertures, and a beam that passes fewer walls than it might may meet more behind them.
    counts_.any_depth = depth < max_depth && walls == max_transmissions_;
    if (!look(scene, apertures,
              {.depth = depth, .max_depth = max_depth, .walls = walls, .edges = max_diffractions_ > 0}, set)) {
      set.regrow(max_depth);
      apertures = start(ends);
      depth = 0;
      continue;
    }
    wt_beam_counters now = lists_.counters.read_one(0, Stage::beam_visible);
    apertures = now.apertures;
    now.apertures = 0;
    lists_.counters.write(std::vector{now}, 0, Stage::beam_visible);
    std::swap(lists_.apertures, lists_.next);
  }
  if (watch_) watch_->tell("rays", max_depth, max_depth);
  const wt_beam_counters end = lists_.counters.read_one(0, Stage::beam_visible);
  counts_.depth = max_depth;
  counts_.left_out_sr = units(end.left_out) * WT_SR_UNIT;
  counts_.thin_sr = units(end.thin) * WT_SR_UNIT;
  counts_.weak_sr = units(end.weak) * WT_WEAK_SR_UNIT;
  return counts_;
}

bool BeamTracing::look(const DeviceScene& scene, uint32_t apertures, const BeamStep& step, Sequences& set) {
  uint32_t block = 0;  // its first aperture
  const auto list = [&](uint32_t first, uint32_t end) {
    block = first;
    return (*gather_)(tree_, scene, lists_, first, end - first, step, most_chunks);
  };
  const auto take = [&](uint32_t chunks) {
    if (watch_) watch_->tell("rays", step.depth - 1, step.max_depth);  // between blocks a frame may be stopped
    (*visible_)(tree_, scene, mirrors_, lists_, block, chunks, step, set.trie());
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
