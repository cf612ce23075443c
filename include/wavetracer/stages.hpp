// The stages of a frame: every name that FrameResult::seconds may have, and the part of the frame that it belongs to.
// Device stages are named where kernels are launched and buffers copied, host stages where a stopwatch is read. A frame
// with a stage that is not listed here fails, so that sums over the parts of a frame are complete.
#pragma once
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "wavetracer/simulation.hpp"

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

struct FrameStage {
  std::string_view name;
  FramePart part;
};

inline constexpr auto frame_stages = std::to_array<FrameStage>({
    {"frame", FramePart::whole},         {"poses", FramePart::world},        {"place", FramePart::world},
    {"order", FramePart::order},         {"sort", FramePart::order},         {"generate_rays", FramePart::discovery},
    {"refine", FramePart::discovery},    {"trace", FramePart::discovery},    {"trace_moving", FramePart::discovery},
    {"compact", FramePart::discovery},   {"scan", FramePart::discovery},     {"interact", FramePart::discovery},
    {"cache_lookup", FramePart::cache},  {"cache_gather", FramePart::cache}, {"cache_store", FramePart::cache},
    {"cache_groups", FramePart::cache},  {"cache_purge", FramePart::cache},  {"receive", FramePart::reception},
    {"waypoints", FramePart::reception}, {"sequences", FramePart::paths},    {"candidates", FramePart::paths},
    {"solve", FramePart::paths},         {"visible", FramePart::paths},      {"occlusion", FramePart::paths},
    {"transmissions", FramePart::paths}, {"wedges", FramePart::paths},       {"wedge_prefixes", FramePart::paths},
    {"wedge_sight", FramePart::paths},   {"wedge_join", FramePart::paths},   {"wedge_pairs", FramePart::paths},
    {"wedge_solve", FramePart::paths},   {"wedge_chains", FramePart::paths}, {"scatter", FramePart::paths},
    {"crowns", FramePart::paths},        {"paths", FramePart::paths},        {"distinct", FramePart::paths},
    {"vegetation", FramePart::fields},   {"path_groups", FramePart::fields}, {"fields", FramePart::fields},
    {"columns", FramePart::fields},      {"elements", FramePart::fields},    {"transfer", FramePart::transfer},
});

constexpr const FrameStage* find_frame_stage(std::string_view name) {
  for (const FrameStage& stage : frame_stages)
    if (stage.name == name) return &stage;
  return nullptr;
}

// Returns 0 for a stage that a frame did not need, which has no entry.
inline double stage_seconds(const StageSeconds& seconds, std::string_view stage) {
  const auto found = seconds.find(std::string(stage));
  return found == seconds.end() ? 0.0 : found->second;
}

inline double part_seconds(const StageSeconds& seconds, FramePart part) {
  double total = 0;
  for (const FrameStage& stage : frame_stages)
    if (stage.part == part) total += stage_seconds(seconds, stage.name);
  return total;
}

// Throws std::logic_error for a stage that is not listed.
inline void check_stages(const StageSeconds& seconds) {
  for (const auto& [stage, value] : seconds)
    if (!find_frame_stage(stage))
      throw std::logic_error("the stage \"" + stage + "\" is missing in include/wavetracer/stages.hpp");
}

}  // namespace wavetracer
