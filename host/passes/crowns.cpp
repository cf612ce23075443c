// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/crowns.cl.
// The host knows the number of rows, so nothing is read back.
#include "passes/crowns.hpp"

#include <algorithm>

#include "passes/advice.hpp"
#include "passes/tile_rows.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

Crowns::Crowns(gpu::Context& context, const std::vector<Cell>& cells, uint32_t first_tile, uint32_t max_depth)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).tiles),
      cells_(static_cast<uint32_t>(cells.size())),
      first_tile_(first_tile) {
  std::vector<double> centres;
  for (const Cell& cell : cells) centres.insert(centres.end(), {cell.centre_m.x, cell.centre_m.y, cell.centre_m.z});
  centres_ = context.buffer(centres, {"cells of vegetation", advice::tiles});
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.deepest = 1;
}

SolvedList& Crowns::operator()(const RadioEnds& ends) {
  links_.update(context_, ends, "links of crowns");
  solved_.count = reserve_tile_rows(context_, solved_, uint64_t{links_.count()} * cells_);
  if (solved_.count > 0)
    kernel_(work_.range(solved_.count), Stage::crowns,
            calls::crowns::crowns{.links = links_.pairs(),
                                  .centres = centres_,
                                  .solved = solved_.headers,
                                  .vertices = solved_.vertices,
                                  .sequences = solved_.sequences,
                                  .args = wt_crowns_arguments{.row_count = solved_.count,
                                                              .rows_per_item = work_.per_item,
                                                              .cells = cells_,
                                                              .first_tile = first_tile_,
                                                              .max_depth = solved_.max_depth}});
  return solved_;
}

}  // namespace wavetracer
