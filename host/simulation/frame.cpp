// Rays discover, geometry decides: see docs/architecture.md. A line's comment names the passes that it runs.
#include "simulation/frame.hpp"

#include "radio/path_power.hpp"
#include "simulation/launch_share.hpp"
#include "simulation/recall_warning.hpp"

namespace wavetracer {
namespace {

double power_of_all(const Paths& paths) {
  double sum = 0;
  for (size_t row = 0; row < paths.size(); ++row) sum += power_of(paths, row);
  return sum;
}

// Every known path is one of all, but for those whose sequences were dropped in this frame.
LateCounts late_counts(const Paths& known, const Paths& all) {
  LateCounts out{.discoveries = 1, .paths = all.size() - std::min(known.size(), all.size()), .all = power_of_all(all)};
  if (out.paths > 0) out.power = std::max(out.all - power_of_all(known), 0.0);
  out.largest_share = out.power_share();
  return out;
}

}  // namespace

// PoCL compiles a kernel for the shape of its first launch, which would take most of the first frame. So what a frame
// launches is launched before, by few rays of one transmitter, and forgotten.
FrameLoop::FrameLoop(Setup& setup) : s_(setup), clock_(setup.config.trace.discover_every_s) {
  if (s_.context.info().cpu) {
    solve({.pose = [this] { return s_.world.state(0); }, .compiling = true});
    forget();
  }
  s_.end_stage("compile");
}

void FrameLoop::forget() {
  warm_frames_ = 0;
  if (s_.cache) s_.cache->clear();
}

// A frame that is given up leaves half of its sequences, which the next one must not take for all. Frames of blocks
// neither reuse anything nor leave anything.
FrameResult FrameLoop::run(const FrameTask& task) {
  if (task.transmitters) forget();
  try {
    FrameResult out = solve(task);
    if (task.transmitters) forget();
    return out;
  } catch (const FrameStopped&) {
    forget();
    throw;
  }
}

FrameResult FrameLoop::solve(const FrameTask& task) {
  s_.context.set_profiling(task.timed);
  FrameAccount account(s_.context, task.frame);
  FrameResult& out = account.result;

  out.world = task.pose();
  std::optional<LinkBlock> block;
  if (task.transmitters)
    block = make_link_block(out.world.links, *task.transmitters, s_.world.receiver_of_transmitter(),
                            s_.world.transmitter_of_receiver(), s_.origins);
  account.end_stage("poses");

  if (s_.placement) s_.placement->place(s_.device_scene, out.world.instances);  // place, sort, top_level
  const std::vector<Link>& links = block ? block->solved : out.world.links;
  set_radio_ends(s_.context, ends_, out.world.transmitters, out.world.receivers, links, s_.origins.listeners);
  const RadioEnds& ends = ends_;
  const bool warm = s_.reuse && warm_frames_ > 0, spared = task.between && warm && clock_.spares();
  DiscoveryMark& discovery = task.discovery ? *task.discovery : discovery_;
  const bool searches = !spared && clock_.due(out.world, !warm, discovery);
  std::optional<Paths> known;  // before rays add to it
  if (searches && warm && clock_.spares()) known = known_paths(task, out.world, ends, account);
  if (searches)
    begin_sequences();
  else
    s_.discovery.sequences().zero_counters();
  if (s_.cache) s_.cache->begin_frame(out.world);
  if (s_.trails) s_.trails->begin_frame(task.frame, ends, out.world);

  DiscoveryCounts found;
  if (searches) found = discover(task, out.world, block ? &*block : nullptr);  // order_keys to refine (discovery.cpp)
  account.discovered(found);
  if (s_.cache) out.cache = s_.cache->summary();
  if (s_.cache && s_.config.output.cache_entries) s_.cache->add_entries(task.frame, out.cache_entries);
  if (s_.trails) out.waypoints = s_.trails->take_waypoints();

  const bool spheres = s_.trails && s_.trails->receives();
  if (spheres)
    receive_paths(ends, account);
  else
    solve_paths(s_.exact_paths, s_.device_scene, ends, s_.discovery.sequences(), searches, s_.frame_watch,
                account);  // sequences to visible
  account.end_stage("paths");

  LeftOut left_out;
  out.paths =
      finished_paths(task.frame, out.world, ends, block ? &block->own : nullptr, left_out, &out.carriers, account);
  if (block) out.world.links = block->own;
  if (spheres || s_.cache) out.paths.quarters.clear();  // what they find, no smaller launch tells of
  if (found.rays > 0) out.missed = missed_counts(out.paths, 0, out.paths.size());
  if (known) out.late = late_counts(*known, out.paths);
  if (const auto text = recall_warning(found, s_.trace, warm_frames_ == 0, out.missed)) account.warn(*text);
  if (searches) ++warm_frames_;
  if (!task.compiling) account.left_out(left_out, task.transmitter_name, task.receiver_name);
  account.end_stage("columns");
  if (s_.elements.on() && !task.compiling) {
    s_.elements(out);
    account.end_stage("elements");
  }
  return account.close();
}

// The paths of the sequences that are known, with the same rules as those of the frame.
Paths FrameLoop::known_paths(const FrameTask& task, const WorldState& world, const RadioEnds& ends,
                             FrameAccount& account) {
  const FrameCounts counts = account.result.counts;
  s_.discovery.sequences().zero_counters();
  solve_paths(s_.exact_paths, s_.device_scene, ends, s_.discovery.sequences(), false, s_.frame_watch, account);
  account.result.counts = counts;
  account.end_stage("paths");
  LeftOut left_out;
  Paths out = finished_paths(task.frame, world, ends, nullptr, left_out, nullptr, account);
  account.end_stage("columns");
  return out;
}

// distinct to fields (finished_paths.cpp)
Paths FrameLoop::finished_paths(uint32_t frame, const WorldState& world, const RadioEnds& ends,
                                const std::vector<Link>* own, LeftOut& left_out, std::vector<CarrierFields>* carriers,
                                FrameAccount& account) {
  DiffractedPaths* edges = s_.exact_paths.diffraction ? &*s_.exact_paths.diffraction : nullptr;
  return s_.finish(frame, s_.device_scene, edges, ends, world, s_.exact_paths.visible.list(), own, left_out, carriers,
                   account);
}

// A cold frame starts from nothing; others go on with the sequences that are still met.
void FrameLoop::begin_sequences() {
  Sequences& sequences = s_.discovery.sequences();
  if (!s_.reuse) warm_frames_ = 0;
  if (warm_frames_ == 0) sequences.clear();
  sequences.begin_frame();
  if (warm_frames_ > 0 && warm_frames_ % s_.trace.forget_frames == 0)
    sequences.forget(s_.trace.forget_frames, s_.trace.max_depth);
}

// With diffraction listeners launch too, and what both ends see meets at the edge.
DiscoveryCounts FrameLoop::discover(const FrameTask& task, const WorldState& world, const LinkBlock* block) {
  std::vector<Launcher> transmitters = sending(world), listeners;
  if (s_.trace.diffraction) listeners = listening(world, s_.origins);
  std::optional<SlopeTables> slopes;
  if (s_.slopes) {
    slopes = s_.slopes->tables(world, s_.origins);
    s_.discovery.set_heights(slopes->values);
  }
  for (std::vector<Launcher>* const ends : {&transmitters, &listeners}) {
    if (block) *ends = launchers_of(*block, *ends);
    if (task.compiling) ends->resize(std::min<size_t>(ends->size(), 1));
    if (!s_.trails) *ends = s_.launch_sides.of(*ends, world);  // trails follow one launch of each transmitter
    if (!slopes) continue;
    for (Launcher& launcher : *ends) launcher.heights = slopes->of_origin[launcher.transmitter];
  }
  if (!s_.trace.rays) {
    transmitters.insert(transmitters.end(), listeners.begin(), listeners.end());
    return s_.discovery.find_refined(s_.device_scene, transmitters, warm_frames_);
  }
  DiscoveryCounts counts;
  for (Launch& launch : frame_launches(s_.trace, std::move(transmitters), std::move(listeners), warm_frames_)) {
    if (task.compiling) launch.share = few_directions(launch.rays);
    counts.add(s_.discovery.find(s_.device_scene, launch));
  }
  return counts;
}

// The thesis' way: rays that pass a receiver's sphere are its paths.
void FrameLoop::receive_paths(const RadioEnds& ends, FrameAccount& account) {
  FrameCounts& counts = account.result.counts;
  counts.sequences = s_.discovery.sequences().collect(ends.transmitter_count) - ends.transmitter_count;
  counts.receptions = s_.trails->receptions();
  account.device_done();
  upload_visible(s_.context, s_.trails->paths(), s_.exact_paths.visible.list());
}

void solve_paths(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, bool searched,
                 const FrameWatch& watch, FrameAccount& account) {
  FrameCounts& counts = account.result.counts;
  uint64_t kinds_done = 0;
  exact.visible.clear(set.counters());
  const auto see = [&](SolvedList& solved) {
    exact.check_legs(scene, ends, solved);  // occlusion or transmissions
    counts.solved += solved.count + solved.hidden;
    exact.visible(solved, set.counters());  // visible
    account.device_done();
    watch.tell("paths", ++kinds_done, exact.kinds());
  };
  watch.tell("paths", 0, exact.kinds());

  uint32_t nodes = set.collect(ends.transmitter_count);  // sequences
  if (searched) {
    set.commute(scene.surfaces, nodes, exact.max_depth);
    nodes = set.collect(ends.transmitter_count);
  }
  counts.sequences = nodes - ends.transmitter_count;

  const uint32_t candidates =
      exact.candidates(scene, ends, set.table(), set.nodes(), nodes, set.counters());  // candidates
  counts.candidates = candidates;
  SolvedList& mirrored = exact.solve(scene, ends, set.table(), set.quarters(), exact.candidates.list(), candidates,
                                     set.counters(), exact.blockers ? &*exact.blockers : nullptr);  // solve
  see(mirrored);
  set.keep(mirrored);

  if (exact.diffraction) {
    DiffractedPaths& edges = *exact.diffraction;
    edges.wedges(scene);  // wedges
    WedgePrefixList& prefixes = edges.prefixes(scene, edges.wedges.list(), ends, set.table(), set.quarters(),
                                               set.nodes(), nodes, set.counters());  // wedge_prefixes
    if (edges.pairs) edges.pairs->sight(scene, edges.wedges.list(), prefixes);       // wedge_sight
    edges.sort(prefixes);                                                            // sort
    const uint32_t joined = edges.join(scene, prefixes, edges.wedges.list(), ends, set.counters(),
                                       edges.for_two());  // wedge_join, wedge_pairs
    counts.candidates += joined;
    see(edges.solve(scene, edges.wedges.list(), ends, set.table(), edges.join.list(), joined,
                    set.counters()));  // wedge_solve
  }
  if (exact.scatter) {
    SolvedList& scattered = (*exact.scatter)(scene, ends, set.table(), set.quarters(), set.nodes(), nodes);  // scatter
    counts.candidates += scattered.count;
    see(scattered);
  }
}

}  // namespace wavetracer
