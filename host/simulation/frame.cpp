// SPDX-License-Identifier: Apache-2.0
// Rays discover, geometry decides: see docs/architecture.md. A line's comment names the passes that it runs.
#include "simulation/frame.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "radio/summed_paths.hpp"
#include "simulation/late_paths.hpp"
#include "simulation/launch_share.hpp"
#include "simulation/recall_warning.hpp"
#include "simulation/solve_paths.hpp"
#include "simulation/tracing_depth.hpp"

namespace wavetracer {

// PoCL compiles a kernel for the shape of its first launch, which would take most of the first frame. So what a frame
// launches is launched before, by few rays of one transmitter, and forgotten.
FrameLoop::FrameLoop(Setup& setup) : s_(setup), plan_(*setup.plan), clock_(plan_.trace.discover_every_s) {
  if (s_.beams) standing_origins_ = standing_origins(plan_.world, plan_.origins);
  if (s_.context.info().cpu) {
    try {
      FrameTask task = FrameTask::to_compile([this] { return plan_.world.state(0); });
      solve(task);
    } catch (const gpu::BufferError&) {
      // Real frames shorten their lists, or report the error.
    }
    forget();
  }
  s_.stages.end("compile");
}

void FrameLoop::forget() {
  if (s_.beams) s_.beams->forget();
  forget_found();
}

void FrameLoop::forget_found() {
  warm_frames_ = 0;
  heard_ = false;
  if (s_.cache) s_.cache->clear();
}

bool FrameLoop::batches_share() const {
  if (s_.exact_paths.from_edges) return true;
  return plan_.origins.listeners.count() == 0 && !s_.beams && !s_.cache && !s_.trails && plan_.trace.rays;
}

// A cancelled frame leaves only a part of its sequences, and the next frame must not take them for all. Frames of a
// part of their links neither reuse sequences nor leave any, except that what listeners hear of edges serves all
// batches of receivers, and that beams are kept for ends, whatever their links.
FrameResult FrameLoop::run(FrameTask task) {
  const bool whole = task.links().is_all(), hears = task.links().is_batch() && batches_share();
  if (whole) heard_ = false;
  if (!whole && !(hears && heard_ && task.links().is_later_batch())) forget_found();
  try {
    FrameResult out = solve(task);
    if (!whole) forget_found();
    heard_ = hears;
    return out;
  } catch (const FrameStopped&) {
    forget();
    throw;
  } catch (const gpu::BufferError&) {
    const bool keeps = s_.beams && s_.beams->kept_bytes() > 0;
    forget();
    places_rest_ = links_rest_ = false;            // not all of them may have been written
    if (!keeps || task.links().is_batch()) throw;  // smaller batches may fit beside them
  }
  const std::string warning = s_.beams->keep_nothing();  // its memory may serve the frame
  FrameResult out = run(std::move(task));
  out.warnings.push_back(warning);
  return out;
}

FrameResult FrameLoop::solve(FrameTask& task) {
  s_.context.set_profiling(task.is_timed());
  FrameAccount account(s_.context, task.frame());
  FrameResult& out = account.result;

  out.world = task.pose();
  std::optional<LinkBlock> block;
  const LinkPart part = task.links();
  if (!part.is_all())
    block = make_link_block(out.world.links, part.transmitters(), part.receivers(),
                            part.is_batch() && batches_share() ? Launching::all_receivers : Launching::own,
                            plan_.world.twins.receiver_of_transmitter, plan_.world.twins.transmitter_of_receiver,
                            plan_.origins);
  account.end_stage(Stage::poses);

  if (s_.placement) s_.placement->place(s_.device_scene, out.world.instances);  // place, sort, top_level
  set_ends(task, out.world, block ? &*block : nullptr);
  const RadioEnds& ends = ends_;
  const bool warm = plan_.reuse && warm_frames_ > 0, spared = task.is_between_poses() && warm && clock_.spares();
  const bool searches = !spared && !heard_ && clock_.due(out.world, !warm, task.mark(discovery_));
  std::optional<Paths> known;  // computed before rays add to the sequences
  if (searches && warm && clock_.spares()) known = known_paths(task.frame(), out.world, ends, account);
  // Frames are alike if they do the same as the one before; those that follow rays and those of blocks of links are
  // not.
  const bool alike = !block && !s_.exact_paths.from_edges && !task.only_compiles() && !known && !s_.cache && !s_.trails;
  if (searches) next_frame(s_.discovery->sequences());
  if (s_.cache) s_.cache->begin_frame(out.world);
  if (s_.trails) s_.trails->begin_frame(task.frame(), ends, out.world);

  const auto [found, counted] = find_paths(task, out.world, ends, block ? &*block : nullptr, searches, alike, account);
  account.discovered(found);
  if (s_.cache) out.cache = s_.cache->summary();
  if (s_.cache && plan_.asked.output.cache_entries) s_.cache->add_entries(task.frame(), out.cache_entries);
  if (s_.trails) out.waypoints = s_.trails->take_waypoints();

  LeftOut left_out;
  if (block) out.world.links = block->own;
  take_paths(task, found, counted, account, left_out);
  if (known) out.late = late_counts(*known, out.paths);
  if (const auto text = recall_warning(found, plan_.trace, warm_frames_ == 0, out.missed)) account.warn(*text);
  if (searches) ++warm_frames_;
  if (part.is_batch())
    part.add_left_out(std::move(left_out));
  else if (!task.only_compiles())
    account.left_out(left_out, task.names().transmitter, task.names().receiver);
  account.end_stage(Stage::columns);
  if (s_.lifetimes && !summed_ && !task.only_compiles()) {
    out.paths.lifetime_m = (*s_.lifetimes)(out.paths, out.world);
    account.end_stage(Stage::lifetimes);
  }
  if (s_.elements.on() && !task.only_compiles() && !part.is_batch()) {
    s_.elements(out);
    account.end_stage(Stage::elements);
  }
  return account.close();
}

// Takes the paths of the frame, or the sums of its links, and what they show of the paths that rays have missed.
void FrameLoop::take_paths(const FrameTask& task, const DiscoveryCounts& found, const wt_counters& counted,
                           FrameAccount& account, LeftOut& left_out) {
  FrameResult& out = account.result;
  std::span<const device::wt_link_sum> sums;
  if (summed_)
    sums = s_.finish.take_sums(counted, left_out);
  else
    out.paths = s_.finish.take(counted, left_out, &out.carriers);
  if (!task.only_compiles()) name_targets(out.paths, plan_.world.targets);
  const SumCounts of_sums = sum_counts(sums);
  if (!task.only_compiles())
    account.near_edges(summed_ ? std::vector{of_sums.near_edges} : s_.finish.near_edges(), out.carriers,
                       plan_.asked.radio.frequency_hz);
  const bool spheres = plan_.trace.by_spheres();
  if (const auto text = witness_.hear(found, warm_frames_ == 0, plan_.has_surfaces() && !spheres)) account.warn(*text);
  const bool told = !s_.cache && !spheres && witness_.tells();
  if (!told || s_.beams) out.paths.quarters.clear();  // they do not estimate misses
  if (summed_)
    out.summed = summed_paths(sums, out.frame, out.world.links, told && !s_.beams, std::exchange(figures_room_, {}));
  if (std::exchange(floors_links_, false)) out.left_out_at_edges = s_.finish.most_left_out();
  if (found.rays > 0 || heard_) {
    out.missed = MissedCounts{.unknown = 1};
    if (told) out.missed = summed_ ? of_sums.missed : missed_counts(out.paths, 0, out.paths.size());
  }
}

// Goes from rays to fields, without waiting for the device if the frame is like the one before. If it proves not to be,
// it runs once more and waits.
FrameLoop::Found FrameLoop::find_paths(const FrameTask& task, const WorldState& world, const RadioEnds& ends,
                                       const LinkBlock* block, bool searches, bool alike, FrameAccount& account) {
  Sequences& set = s_.discovery->sequences();
  const Search search = !searches || s_.beams ? Search::none : task.only_compiles() ? Search::few : Search::all;
  Found out;
  Uncounted besides;
  const auto passes = [&] {
    out.rays = searches ? discover(task, world, block) : DiscoveryCounts{};  // order_keys to refine (discovery.cpp)
    besides = plan_.trace.by_spheres()
                  ? receive_paths(ends, account)
                  : solve_paths(s_.exact_paths, s_.device_scene, ends, set, search, *s_.frame_watch, account, [&] {
                      return floor_links(world, ends, task.only_compiles());
                    });  // sequences to visible
    account.end_stage(Stage::paths);
    finish_paths(task.frame(), world, ends, block ? &block->own : nullptr,
                 summed_ ? Rows::summed : Rows::all_carriers);  // distinct to fields, link_sums
  };
  out.counted = set.counters().settled(
      alike, Stage::fields, [&] { return begin_sequences(set, searches); }, passes,
      [&](const wt_counters& now) {
        account.device_done();
        account.counted(now, ends.transmitter_count, besides);
      });
  out.rays.add(besides.rays);
  if (out.rays.unread > 0) out.rays.add_ended(out.rays.unread, out.counted.ended);
  return out;
}

// The paths of the known sequences, by the same rules as those of the frame.
Paths FrameLoop::known_paths(uint32_t frame, const WorldState& world, const RadioEnds& ends, FrameAccount& account) {
  Sequences& set = s_.discovery->sequences();
  const auto passes = [&] {
    solve_paths(s_.exact_paths, s_.device_scene, ends, set, Search::none, *s_.frame_watch, account,
                [&] { return floor_links(world, ends, false); });
    account.end_stage(Stage::paths);
    finish_paths(frame, world, ends, nullptr, Rows::first_carrier);
  };
  const wt_counters counted = set.counters().settled(
      false, Stage::fields, [&] { return set.counters().zero(); }, passes,
      [&](const wt_counters&) { account.device_done(); });
  LeftOut left_out;
  Paths out = s_.finish.take(counted, left_out, nullptr);
  name_targets(out, plan_.world.targets);
  account.end_stage(Stage::columns);
  return out;
}

// distinct to fields (finished_paths.cpp)
void FrameLoop::finish_paths(uint32_t frame, const WorldState& world, const RadioEnds& ends,
                             const std::vector<Link>* own, Rows rows) {
  const TargetRows* targets = s_.exact_paths.targets ? &*s_.exact_paths.targets : nullptr;
  DiffractedPaths* edges = s_.exact_paths.diffraction ? &*s_.exact_paths.diffraction : nullptr;
  s_.finish.start(frame, s_.device_scene, edges, targets, ends, world, s_.exact_paths.visible.list(), own, rows,
                  s_.discovery->sequences().counters());
}

std::optional<LinkLimits> FrameLoop::floor_links(const WorldState& world, const RadioEnds& ends, bool compiles) {
  floors_links_ = compiles || summed_ || plan_.asked.trace.diffraction_range_db;
  if (!floors_links_) return {};
  return s_.finish.floor_links(s_.device_scene, ends, world, s_.exact_paths.visible.list(),
                               s_.discovery->sequences().counters());
}

// Sequences entered from now on are younger than all before, and those that are too old are dropped.
void FrameLoop::next_frame(Sequences& set) {
  if (!plan_.reuse) warm_frames_ = 0;
  set.begin_frame();
  if (warm_frames_ > 0 && warm_frames_ % plan_.trace.forget_frames == 0)
    set.forget(plan_.trace.forget_frames, plan_.trace.max_depth);
}

// A cold frame starts from nothing; others go on with the sequences that are still met.
Counters::Zeroed FrameLoop::begin_sequences(Sequences& set, bool searches) {
  return searches && warm_frames_ == 0 ? set.clear() : set.counters().zero();
}

void FrameLoop::set_ends(const FrameTask& task, const WorldState& world, const LinkBlock* block) {
  const bool cut = block && s_.exact_paths.from_edges;  // the other receivers have heard, too
  ends_.moved = !(rests(task) && places_rest_);
  if (ends_.moved || cut) s_.exact_paths.place_targets(world, plan_.origins.listeners.receivers);
  if (ends_.moved || cut)
    set_places(s_.context, ends_, world.transmitters, world.receivers, cut ? block->listeners : plan_.origins.listeners,
               plan_.origins.receiver_of_transmitter);
  places_rest_ = rests(task) && !cut;
  if (rests(task) && links_rest_ && !block) return;
  links_rest_ = false;
  set_links(s_.context, ends_, world.receivers, block ? block->solved : world.links);
  links_rest_ = rests(task) && !block;
}

DiscoveryCounts FrameLoop::discover(const FrameTask& task, const WorldState& world, const LinkBlock* block) {
  if (s_.beams) return follow_beams(task, world, block);
  const bool stays = rests(task);
  if (!stays || !launch_) launch_ = plan_launch(s_, world, stays ? nullptr : block, task.only_compiles());
  const auto here = [&](const std::vector<Launcher>& all) { return block ? launchers_of(*block, all) : all; };
  std::vector<Launcher> transmitters = here(launch_->transmitters), listeners = here(launch_->listeners);
  if (!launch_->tables.values.empty()) s_.discovery->set_heights(launch_->tables.values);
  DiscoveryCounts out;
  if (!plan_.trace.rays) {
    transmitters.insert(transmitters.end(), listeners.begin(), listeners.end());
    out = s_.discovery->find_refined(s_.device_scene, transmitters, warm_frames_);
  } else {
    std::vector<Launch> launches =
        frame_launches(plan_.trace, std::move(transmitters), std::move(listeners), warm_frames_);
    for (Launch& launch : launches)
      if (task.only_compiles()) launch.share = few_directions(launch.rays);
    out = s_.discovery->find_all(s_.device_scene, launches);
  }
  out.spread_m2 = launch_->spread_m2;
  if (!stays) launch_.reset();
  return out;
}

// The thesis' method: a ray that passes a receiver's sphere is a path.
Uncounted FrameLoop::receive_paths(const RadioEnds& ends, FrameAccount& account) {
  Sequences& set = s_.discovery->sequences();
  set.collect(ends.transmitter_count);
  account.result.counts.receptions = s_.trails->receptions();
  account.device_done();
  SolvedList& visible = s_.exact_paths.visible.list();
  upload_visible(s_.context, s_.trails->paths(), visible);
  set.counters().restart(&wt_counters::visible, visible.count, Stage::visible);
  return {};
}

}  // namespace wavetracer
