// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_solve.cl.
// One candidate per work-item, or a run of them on CPUs, whose rows are near each other then.
#include "passes/wedge_solve.hpp"

#include <string>
#include <utility>

#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {
namespace {

// CPUs: candidates of a work-item, and the largest depth whose points it keeps until it knows their places.
constexpr uint32_t run_of_item = 16, deepest_of_run = 8;

uint32_t run_of(const gpu::DeviceInfo& device, uint32_t max_depth) {
  return device.cpu && max_depth <= deepest_of_run ? run_of_item : 1;
}

gpu::Definitions build_of_run(uint32_t run, uint32_t max_depth) {
  if (run == 1) return {};
  return {{"WT_TOGETHER", std::to_string(run) + "u"}, {"WT_ROOM", std::to_string(max_depth) + "u"}};
}

}  // namespace

WedgeSolve::WedgeSolve(gpu::Context& context, uint32_t max_depth, double wavelength_m, BendFloors floors)
    : context_(context),
      work_(tuning_of(context.info()).exact),
      kernel_(context, build_of_run(run_of(context.info(), max_depth), max_depth)),
      wavelength_m_(static_cast<float>(wavelength_m)),
      floors_(floors) {
  work_.per_item = run_of(context.info(), max_depth);
  if (work_.per_item > 1) work_.group = 1;
  solved_.max_depth = max_depth;
  solved_.counter = counter_word(&wt_counters::wedge_solved);
  solved_.reserve(context, 1 << 12);
}

SolvedList& WedgeSolve::operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                                   const gpu::Buffer<uint64_t>& trie, const gpu::Buffer<wt_wedge_candidate>& candidates,
                                   uint32_t candidate_count, Counters& counters, const LinkLimits* limits) {
  // A list that was too short is made again, and parts are counted once.
  const gpu::Buffer<uint32_t>* left_out = limits ? &limits->left_out : nullptr;
  const auto run = [&] {
    kernel_(work_.range(candidate_count), Stage::wedge_solve,
            calls::wedge_solve::wedge_solve{
                .table = trie,
                .origins = ends.transmitters,
                .receivers = ends.receivers,
                .surfaces = scene.exact_surfaces,
                .triangles = scene.exact_triangles,
                .instances = scene.exact_instances,
                .wedges = wedges.wedges,
                .candidates = candidates,
                .link_floors = limits ? &limits->floors : nullptr,
                .left_out = std::exchange(left_out, nullptr),
                .reflectances = limits ? &limits->reflectances : nullptr,
                .materials_of = limits ? &limits->materials_of : nullptr,
                .solved = solved_.headers,
                .vertices = solved_.vertices,
                .sequences = solved_.sequences,
                .counters = counters.buffer(),
                .args = wt_solve_arguments{.candidate_count = candidate_count,
                                           .max_depth = solved_.max_depth,
                                           .capacity = static_cast<uint32_t>(solved_.headers.size()),
                                           .triangle_slots = 0,
                                           .blocker_mask = 0,
                                           .wavelength_m = wavelength_m_,
                                           .floors = {floors_.one, floors_.two},
                                           .second = limits ? limits->second : 0,
                                           .left_out_unit = limits ? limits->left_out_unit : 0,
                                           .receiver_count = limits ? limits->receiver_count : 0}});
  };
  solved_.count = fill_list(
      counters, &wt_counters::wedge_solved, Stage::wedge_solve, [&] { return solved_.headers.size(); }, run,
      [&](size_t rows) { solved_.reserve(context_, rows); });
  return solved_;
}

}  // namespace wavetracer
