// SPDX-License-Identifier: Apache-2.0
// Streets are straight lines from edge to edge of the grid, see CityOptions.
#include "scene/streets.hpp"

namespace wavetracer {

std::vector<Street> city_streets(const CityOptions& options) {
  std::vector<Street> out;
  const double period_m = double{1} * options.block_m + options.street_m, width_m = options.street_m;
  const auto place_m = [&](uint32_t i, uint32_t blocks) { return (i - blocks / 2.0) * period_m; };
  const double end_x = place_m(options.blocks_x, options.blocks_x) + width_m / 2,
               end_y = place_m(options.blocks_y, options.blocks_y) + width_m / 2;
  for (uint32_t i = 0; i <= options.blocks_x; ++i) {
    const double x = place_m(i, options.blocks_x);
    out.push_back({{{x, -end_y, 0}, {x, end_y, 0}}, width_m});
  }
  for (uint32_t i = 0; i <= options.blocks_y; ++i) {
    const double y = place_m(i, options.blocks_y);
    out.push_back({{{-end_x, y, 0}, {end_x, y, 0}}, width_m});
  }
  return out;
}

}  // namespace wavetracer
