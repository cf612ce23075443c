// Geometry decides.
// Rows come in any order from the device; distinct_paths makes the result independent of it.
#include "simulation/exact_paths.hpp"

#include <algorithm>

#include "simulation/distinct_paths.hpp"
#include "simulation/visible_paths.hpp"

namespace wavetracer {

namespace {

uint32_t surface_count(const Scene& scene, const World& world) {
  size_t count = scene.surfaces.size();
  for (const Instance& instance : world.instances()) count += world.models()[instance.model].surfaces.size();
  return static_cast<uint32_t>(count);
}

}  // namespace

ExactPaths::ExactPaths(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, const World& world,
                       const TraceConfig& trace, const Origins& origins)
    : max_depth_(trace.max_depth),
      candidates_(context, trace.reflection ? trace.max_depth : 0),
      solve_(context, trace.max_depth),
      visible_(context, trace.max_depth) {
  if (trace.diffraction)
    diffraction_.emplace(context, Wedges(context, scene, world.models(), world.instances(), trace.free_edges),
                         origins.receiver_of_origin, trace);
  if (trace.scattering)
    scatter_.emplace(context, TileTable(scene, world.models(), world.instances(), trace.tile_m),
                     surface_count(scene, world), trace.max_depth);
  if (trace.transmission)
    transmissions_.emplace(context, device_scene, std::min(trace.max_transmissions, trace.max_depth));
  else
    occlusion_.emplace(context, device_scene);
}

PathGeometry ExactPaths::operator()(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences,
                                    FrameCounts& counts, Stopwatch& host) {
  tell(0);
  uint32_t node_count = sequences.collect(ends.transmitter_count);
  sequences.commute(scene.surfaces, node_count, max_depth_);
  node_count = sequences.collect(ends.transmitter_count);
  counts.sequences = node_count - ends.transmitter_count;
  PathGeometry paths;
  SolvedList& mirrored = specular(scene, ends, sequences, node_count, counts);
  check_legs(scene, ends, mirrored, counts);
  sequences.keep(mirrored);
  append(mirrored, sequences, paths, host);
  tell(1);
  if (diffraction_) {
    SolvedList& diffracted = (*diffraction_)(scene, ends, sequences, node_count, counts.candidates);
    check_legs(scene, ends, diffracted, counts);
    append(diffracted, sequences, paths, host);
    tell(2);
  }
  if (scatter_) {
    SolvedList& scattered =
        (*scatter_)(scene, ends, sequences.table(), sequences.quarters(), sequences.nodes(), node_count);
    counts.candidates += scattered.count;
    check_legs(scene, ends, scattered, counts);
    append(scattered, sequences, paths, host);
  }
  return distinct_paths(paths);
}

SolvedList& ExactPaths::specular(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences,
                                 uint32_t node_count, FrameCounts& counts) {
  const uint32_t count =
      candidates_(scene, ends, sequences.table(), sequences.nodes(), node_count, sequences.counters());
  counts.candidates = count;
  return solve_(scene, ends, sequences.table(), sequences.quarters(), candidates_.list(), count, sequences.counters());
}

void ExactPaths::check_legs(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, FrameCounts& counts) {
  if (transmissions_)
    (*transmissions_)(scene, ends, solved);
  else
    (*occlusion_)(scene, ends, solved);
  counts.solved += solved.count;
}

void ExactPaths::append(const SolvedList& solved, Sequences& sequences, PathGeometry& paths, Stopwatch& host) {
  const SolvedList& seen = visible_(solved, sequences.counters());
  host.lap();
  append_visible(seen, paths);
}

}  // namespace wavetracer
