// SPDX-License-Identifier: Apache-2.0
// The counters are the pass's own, so nothing of it is foreseen from the frame before.
#include "simulation/target_chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"

namespace wavetracer {
namespace {

// Pairs of an end and a point, which take 8 bytes each on the host.
constexpr uint64_t most_pairs_of_points = uint64_t{1} << 28;

// A piece of a body is hidden by all other parts of the body.
std::vector<EndState> as_receivers(const std::vector<TargetState>& targets) {
  std::vector<EndState> out;
  for (const TargetState& point : targets)
    out.push_back({.position_m = point.position_m,
                   .instance = point.surface == no_target_surface ? point.instance : no_instance,
                   .present = point.present});
  return out;
}

// The pairs of an end and a point that may have a path above the floor. No way between them is shorter than the
// straight one, and none on the other side of the point is shorter than that to the nearest end. A floor of 0 takes
// all.
std::vector<Link> strong_pairs(const std::vector<EndState>& ends, const std::vector<EndState>& points,
                               const JoinedPoints& limits) {
  const double most_of_edges = std::pow(WT_MOST_OF_EDGE, std::min(limits.diffractions, 2u));
  std::vector<double> farthest_m2(points.size(), std::numeric_limits<double>::infinity());
  const auto square = [&](uint32_t end, uint32_t point) {
    const glm::dvec3 way = ends[end].position_m - points[point].position_m;
    return glm::dot(way, way);
  };
  for (uint32_t point = 0; point < points.size() && limits.floor > 0; ++point) {
    double nearest_m2 = std::numeric_limits<double>::infinity();
    for (uint32_t end = 0; end < ends.size(); ++end)
      if (ends[end].present) nearest_m2 = std::min(nearest_m2, square(end, point));
    farthest_m2[point] = most_of_edges * limits.powers[point] / (limits.floor * nearest_m2);
  }
  if (uint64_t{ends.size()} * points.size() > most_pairs_of_points)
    throw gpu::BufferError(fmt::format("{} ends look for {} points of targets, more than {} pairs. {}", ends.size(),
                                       points.size(), most_pairs_of_points, advice::targets));
  std::vector<Link> out;
  for (uint32_t end = 0; end < ends.size(); ++end)
    for (uint32_t point = 0; point < points.size(); ++point)
      if (ends[end].present && points[point].present && !(square(end, point) > farthest_m2[point]))
        out.push_back({end, point});
  return out;
}

}  // namespace

TargetChains::TargetChains(gpu::Context& context, uint32_t interactions, const JoinedPoints& limits,
                           double longest_wavelength_m)
    : context_(context),
      limits_(limits),
      local_(tuning_of(context.info()).exact.group),
      counters_(context),
      candidates_(context, interactions),
      solve_(context, limits.row_depth),
      rows_(context),
      place_(context),
      sort_(context),
      join_(context, limits) {
  if (limits.diffractions > 0)
    edge_ways_.emplace(EdgeWays{{context, interactions, longest_wavelength_m},
                                {context, limits.row_depth, longest_wavelength_m},
                                {context, limits.row_depth}});
}

void TargetChains::place(const std::vector<EndState>& launching, const std::vector<TargetState>& targets) {
  const std::vector<EndState> points = as_receivers(targets);
  set_places(context_, ends_, launching, points, {});
  set_links(context_, ends_, points, strong_pairs(launching, points, limits_));
}

uint32_t TargetChains::list_nodes(const FoundSequences& found, uint32_t transmitters) {
  std::vector<uint32_t> roots;
  for (uint32_t end = transmitters; end < ends_.transmitter_count; ++end) roots.push_back(WT_ROOT | end);
  const size_t count = found.node_count + roots.size();
  if (!nodes_ || nodes_.size() < count)
    nodes_ = context_.buffer<uint32_t>(count + count / 4, {"sequences of targets", advice::targets});
  context_.copy(found.nodes, nodes_, sizeof(uint32_t) * found.node_count, Stage::targets);
  if (!roots.empty()) nodes_.write(roots, found.node_count, Stage::targets);
  return static_cast<uint32_t>(count);
}

void TargetChains::sort(const DeviceScene& scene, SolvedList& ways, const RadioEnds& ends, const TargetRows& targets) {
  list_.rows = ways;
  list_.hidden = wt_point_key(targets.count(), 0);
  if (!list_.keys || list_.keys.size() < ways.headers.size()) {
    const size_t rows = ways.headers.size();
    list_.keys = context_.buffer<uint32_t>(rows, {"keys of targets", advice::targets});
    list_.order = context_.buffer<uint32_t>(rows, {"order of targets", advice::targets});
    list_.sorted = context_.buffer<wt_point_prefix>(rows, {"ways to targets", advice::targets});
  }
  rows_({ways.count, local_}, Stage::targets,
        calls::targets::target_rows{.points = targets.points(),
                                    .ends = ends.transmitters,
                                    .surfaces = scene.exact_surfaces,
                                    .solved = list_.rows.headers,
                                    .vertices = list_.rows.vertices,
                                    .sequences = list_.rows.sequences,
                                    .keys = list_.keys,
                                    .count = ways.count,
                                    .max_depth = ways.max_depth,
                                    .most_depth = limits_.max_depth,
                                    .hidden = list_.hidden});
  sort_(list_.keys, list_.order, ways.count, list_.key_bits());
  place_({ways.count, local_}, Stage::targets,
         calls::point_prefixes::place_points{.keys = list_.keys,
                                             .order = list_.order,
                                             .solved = list_.rows.headers,
                                             .vertices = list_.rows.vertices,
                                             .sequences = list_.rows.sequences,
                                             .ends = ends.transmitters,
                                             .wedges = nullptr,
                                             .sorted = list_.sorted,
                                             .count = ways.count,
                                             .max_depth = ways.max_depth,
                                             .hidden = list_.hidden,
                                             .wavelength_m = 0.0,
                                             .wave_m = 0.0});
}

SolvedList& TargetChains::mirrored_ways(const DeviceScene& scene, const FoundSequences& found, uint32_t transmitters,
                                        const CheckLegs& check_legs) {
  const uint32_t nodes = list_nodes(found, transmitters);
  counters_.restart_nodes(nodes, Stage::targets);
  const uint32_t candidates = candidates_(scene, ends_, found.table, nodes_, nodes, counters_);  // candidates
  SolvedList& ways =
      solve_(scene, ends_, found.table, found.quarters, candidates_.list(), candidates, counters_);  // solve
  check_legs(ways, ends_, counters_);  // the passes of legs (exact_paths.cpp)
  return ways;
}

void TargetChains::add_edge_ways(const DeviceScene& scene, const FoundSequences& found, const TargetRows& targets,
                                 const SeenEdges& edges, const CheckLegs& check_legs) {
  by_parts(
      edges.prefixes.count, edges.prefixes.count, edges.candidates.most(),
      [&](uint32_t first, uint32_t end) {
        return edge_ways_->pass(scene, edges.prefixes, first, end, edges.wedges, ends_, targets, edges.candidates,
                                counters_);  // target_edges
      },
      [&](uint32_t candidates) {
        SolvedList& ways = edge_ways_->solve(scene, edges.wedges, ends_, found.table, edges.candidates.list(),
                                             candidates, counters_);  // wedge_solve
        check_legs(ways, ends_, counters_);                           // the passes of legs
        edge_ways_->all(ways, counters_);                             // visible
      },
      [&](uint32_t) {
        counters_.restart(&wt_counters::wedge_candidates, 0, Stage::targets);
        counters_.restart(&wt_counters::wedge_solved, 0, Stage::targets);
      },
      [&](uint32_t candidates) { edges.candidates.refuse(candidates); });
}

JoinedCounts TargetChains::operator()(const DeviceScene& scene, const RadioEnds& ends, const FoundSequences& found,
                                      const TargetRows& targets, const SeenEdges* edges, const CheckLegs& check_legs,
                                      const std::function<void(SolvedList&)>& take) {
  JoinedCounts out;
  counters_.zero();
  SolvedList* ways = &mirrored_ways(scene, found, ends.transmitter_count, check_legs);
  if (edges) {
    edge_ways_->all.clear();
    edge_ways_->all(*ways, counters_);  // visible
    add_edge_ways(scene, found, targets, *edges, check_legs);
    ways = &edge_ways_->all.list();
  }
  if (ways->count == 0) return out;
  sort(scene, *ways, ends, targets);  // targets, sort, point_prefixes
  by_parts(
      ways->count, ways->count, join_.most(),
      [&](uint32_t first, uint32_t end) { return join_(list_, first, end, ends); },  // point_join
      [&](uint32_t joined) {
        take(join_.list());
        out.paths += joined;
        out.weak += join_.weak();
      },
      [](uint32_t) {}, [&](uint32_t paths) { join_.refuse(paths); });
  return out;
}

}  // namespace wavetracer
