// SPDX-License-Identifier: Apache-2.0
// The stages of a frame: every name that FrameResult::seconds may have, and the part of the frame that it belongs to.
// Device stages are given where kernels are launched and buffers copied, host stages where a stopwatch is read. A stage
// that is not listed here does not compile, so that sums over the parts of a frame are complete.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace wavetracer {

enum class FramePart {
  whole,      // from poses to fields, wall time; all other stages are inside of it
  world,      // moving vehicles to their places
  order,      // keys, sorts and moves that put rays in order
  discovery,  // rays from launch to sequences
  cache,      // additional time of a ray cache in discovery
  reception,  // receivers that rays pass, and waypoints
  paths,      // sequences to exact paths
  fields,     // coefficients of paths
  transfer,   // copies that belong to no other stage
};

// The purpose of a launch, a copy or a lap of the stopwatch.
enum class Stage : uint8_t {
  frame,
  poses,
  place,
  order,
  sort,
  generate_rays,
  refine,
  trace,
  trace_moving,
  compact,
  scan,
  interact,
  beam_gather,
  beam_visible,
  edge_rays,
  hear,
  cache_lookup,
  cache_gather,
  cache_store,
  cache_groups,
  cache_purge,
  receive,
  waypoints,
  sequences,
  candidates,
  solve,
  visible,
  occlusion,
  transmissions,
  wedges,
  grazed_faces,
  wedge_prefixes,
  wedge_sight,
  link_floors,
  wedge_join,
  heard_join,
  wedge_pairs,
  wedge_solve,
  wedge_chains,
  scatter,
  point_prefixes,
  point_join,
  tile_edges,
  crowns,
  targets,
  paths,
  distinct,
  vegetation,
  path_groups,
  fields,
  link_sums,
  columns,
  lifetimes,
  elements,
  transfer,
};

struct FrameStage {
  Stage stage;
  std::string_view name;
  FramePart part;
};

// A row for each stage, in their order.
inline constexpr auto frame_stages = std::to_array<FrameStage>({
    {Stage::frame, "frame", FramePart::whole},
    {Stage::poses, "poses", FramePart::world},
    {Stage::place, "place", FramePart::world},
    {Stage::order, "order", FramePart::order},
    {Stage::sort, "sort", FramePart::order},
    {Stage::generate_rays, "generate_rays", FramePart::discovery},
    {Stage::refine, "refine", FramePart::discovery},
    {Stage::trace, "trace", FramePart::discovery},
    {Stage::trace_moving, "trace_moving", FramePart::discovery},
    {Stage::compact, "compact", FramePart::discovery},
    {Stage::scan, "scan", FramePart::discovery},
    {Stage::interact, "interact", FramePart::discovery},
    {Stage::beam_gather, "beam_gather", FramePart::discovery},
    {Stage::beam_visible, "beam_visible", FramePart::discovery},
    {Stage::edge_rays, "edge_rays", FramePart::discovery},
    {Stage::hear, "hear", FramePart::discovery},
    {Stage::cache_lookup, "cache_lookup", FramePart::cache},
    {Stage::cache_gather, "cache_gather", FramePart::cache},
    {Stage::cache_store, "cache_store", FramePart::cache},
    {Stage::cache_groups, "cache_groups", FramePart::cache},
    {Stage::cache_purge, "cache_purge", FramePart::cache},
    {Stage::receive, "receive", FramePart::reception},
    {Stage::waypoints, "waypoints", FramePart::reception},
    {Stage::sequences, "sequences", FramePart::paths},
    {Stage::candidates, "candidates", FramePart::paths},
    {Stage::solve, "solve", FramePart::paths},
    {Stage::visible, "visible", FramePart::paths},
    {Stage::occlusion, "occlusion", FramePart::paths},
    {Stage::transmissions, "transmissions", FramePart::paths},
    {Stage::wedges, "wedges", FramePart::paths},
    {Stage::grazed_faces, "grazed_faces", FramePart::paths},
    {Stage::wedge_prefixes, "wedge_prefixes", FramePart::paths},
    {Stage::wedge_sight, "wedge_sight", FramePart::paths},
    {Stage::link_floors, "link_floors", FramePart::paths},
    {Stage::wedge_join, "wedge_join", FramePart::paths},
    {Stage::heard_join, "heard_join", FramePart::paths},
    {Stage::wedge_pairs, "wedge_pairs", FramePart::paths},
    {Stage::wedge_solve, "wedge_solve", FramePart::paths},
    {Stage::wedge_chains, "wedge_chains", FramePart::paths},
    {Stage::scatter, "scatter", FramePart::paths},
    {Stage::point_prefixes, "point_prefixes", FramePart::paths},
    {Stage::point_join, "point_join", FramePart::paths},
    {Stage::tile_edges, "tile_edges", FramePart::paths},
    {Stage::crowns, "crowns", FramePart::paths},
    {Stage::targets, "targets", FramePart::paths},
    {Stage::paths, "paths", FramePart::paths},
    {Stage::distinct, "distinct", FramePart::paths},
    {Stage::vegetation, "vegetation", FramePart::fields},
    {Stage::path_groups, "path_groups", FramePart::fields},
    {Stage::fields, "fields", FramePart::fields},
    {Stage::link_sums, "link_sums", FramePart::fields},
    {Stage::columns, "columns", FramePart::fields},
    {Stage::lifetimes, "lifetimes", FramePart::paths},
    {Stage::elements, "elements", FramePart::fields},
    {Stage::transfer, "transfer", FramePart::transfer},
});

constexpr bool stages_in_order() {
  for (size_t i = 0; i < frame_stages.size(); ++i)
    if (frame_stages[i].stage != static_cast<Stage>(i)) return false;
  return frame_stages.size() == static_cast<size_t>(Stage::transfer) + 1;
}
static_assert(stages_in_order());

constexpr std::string_view stage_name(Stage stage) { return frame_stages[static_cast<size_t>(stage)].name; }

// Seconds by the names of stages: device stages from profiling events, host stages from a steady clock.
using StageSeconds = std::map<std::string, double>;

constexpr const FrameStage* find_frame_stage(std::string_view name) {
  for (const FrameStage& stage : frame_stages)
    if (stage.name == name) return &stage;
  return nullptr;
}

// Returns 0 for a stage that a frame did not need, which has no entry.
inline double stage_seconds(const StageSeconds& seconds, Stage stage) {
  const auto found = seconds.find(std::string(stage_name(stage)));
  return found == seconds.end() ? 0.0 : found->second;
}

inline double part_seconds(const StageSeconds& seconds, FramePart part) {
  double total = 0;
  for (const FrameStage& stage : frame_stages)
    if (stage.part == part) total += stage_seconds(seconds, stage.stage);
  return total;
}

// Throws std::logic_error for a stage that is not listed.
inline void check_stages(const StageSeconds& seconds) {
  for (const auto& [stage, value] : seconds)
    if (!find_frame_stage(stage))
      throw std::logic_error("the stage \"" + stage + "\" is missing in include/wavetracer/stages.hpp");
}

}  // namespace wavetracer
