// SPDX-License-Identifier: Apache-2.0
// The counters are its own, so nothing of it is foreseen from the frame before. A path has one edge, so each list of
// ways is joined with all prefixes, and lists need not be kept.
#include "simulation/scattered_edges.hpp"

#include <fmt/format.h>

#include "base/digits.hpp"
#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Pairs of a way to an edge and a tile that are tried without a floor: they take some minutes on two cores.
constexpr uint64_t most_pairs_of_edges = uint64_t{1} << 36;

JoinedPoints with_one_edge(JoinedPoints limits) {
  limits.diffractions = limits.bends = 1;
  return limits;
}

}  // namespace

std::string warning_of_pairs(uint64_t ends, uint64_t edges, uint64_t tiles, bool has_floor) {
  if (has_floor || static_cast<double>(ends) * static_cast<double>(edges) * static_cast<double>(tiles) <=
                       static_cast<double>(most_pairs_of_edges))
    return "";
  return fmt::format(
      "trace.scattering_diffraction without trace.scattering_floor_db tries every way from an end to an edge with every "
      "tile: {} ends that launch rays, {} edges and {} tiles may be more than {} pairs, and a frame with more of them is "
      "refused while it is computed: give trace.scattering_floor_db, so that most are left out together, or raise "
      "trace.tile_m",
      grouped(ends), grouped(edges), grouped(tiles), grouped(most_pairs_of_edges));
}

ScatteredEdges::ScatteredEdges(gpu::Context& context, const TileTable& tiles, uint32_t interactions,
                               JoinedPoints limits, const BentWaves& waves)
    : context_(context),
      waves_(waves),
      floor_(limits.floor),
      counters_(context),
      pass_(context, tiles, interactions, limits, waves),
      solve_(context, limits.row_depth, waves.wavelength_m),
      all_(context, limits.row_depth),
      sort_(context),
      join_(context, with_one_edge(limits)) {
  if (const auto most = most_points_of_tests()) join_.set_most(*most);
}

bool ScatteredEdges::sort(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                          const SeenEdges& edges, PointPrefixes& points, const SolvedList& ways) {
  all_.clear();
  all_(ways, counters_);  // visible
  if (all_.list().count == 0) return false;
  all_(points.list().rows, counters_);
  list_.rows = all_.list();
  list_.rows.open = 1;
  list_.hidden = points.list().hidden;
  const size_t rows = list_.rows.headers.size();
  if (!list_.keys || list_.keys.size() < rows) {
    list_.keys = context_.buffer<uint32_t>(rows, {"keys of tiles", advice::points});
    list_.order = context_.buffer<uint32_t>(rows, {"order of tiles", advice::points});
    list_.sorted = context_.buffer<wt_point_prefix>(rows, {"prefixes of tiles", advice::points});
  }
  points.make_keys(scene, tiles, ends, list_);
  sort_(list_.keys, list_.order, list_.rows.count, list_.key_bits());
  points.place(ends, list_, &edges.wedges.wedges, waves_);
  return true;
}

JoinedCounts ScatteredEdges::operator()(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                                        const FoundSequences& found, const SeenEdges& edges, PointPrefixes& points,
                                        const CheckLegs& check_legs, const std::function<void(SolvedList&)>& take) {
  JoinedCounts out;
  const uint32_t prefixes = edges.prefixes.count;
  if (floor_ == 0 && uint64_t{prefixes} * tiles.count > most_pairs_of_edges)
    throw RuntimeError(fmt::format(
        "trace.scattering_diffraction would try {} ways to edges with {} tiles each, more than {} pairs: give "
        "trace.scattering_floor_db, so that most are left out together, raise trace.tile_m, or set "
        "trace.scattering_diffraction to false",
        grouped(prefixes), grouped(tiles.count), grouped(most_pairs_of_edges)));
  pass_.place(scene, tiles, ends, points.list());  // tile_edges
  RadioEnds between;
  between.transmitters = ends.transmitters;
  between.receivers = pass_.places();
  counters_.zero();
  by_parts(
      prefixes, prefixes, edges.candidates.most(),
      [&](uint32_t first, uint32_t end) {
        return pass_(scene, edges.prefixes, first, end, edges.wedges, ends, points.list(), edges.candidates,
                     counters_);  // tile_edges
      },
      [&](uint32_t candidates) {
        if (candidates == 0) return;
        SolvedList& ways = solve_(scene, edges.wedges, between, found.table, edges.candidates.list(), candidates,
                                  counters_);               // wedge_solve
        pass_.make_rows(scene, tiles, ways);                // tile_edges
        check_legs(ways, counters_);                        // the passes of legs (exact_paths.cpp)
        if (sort(scene, tiles, ends, edges, points, ways))  // visible, point_prefixes, sort
          out += join_prefixes_of_points(join_, list_, ends, take);
      },
      [&](uint32_t) { counters_.zero(); }, [&](uint32_t candidates) { edges.candidates.refuse(candidates); });
  return out;
}

}  // namespace wavetracer
