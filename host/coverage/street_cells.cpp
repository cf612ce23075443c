// SPDX-License-Identifier: Apache-2.0
#include "coverage/street_cells.hpp"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace wavetracer::coverage {
namespace {

double distance_m(const glm::dvec2& p, const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 way = to - from;
  const double square = glm::dot(way, way);
  const double share = square > 0 ? std::clamp(glm::dot(p - from, way) / square, 0.0, 1.0) : 0.0;
  return glm::distance(p, from + share * way);
}

// The numbers of columns or rows whose middles lie from low to high; first > last if there are none.
struct Numbers {
  int64_t first, last;
};
Numbers numbers_between(double low_m, double high_m, double first_m, double step_m, uint32_t count) {
  return {static_cast<int64_t>(std::clamp(std::ceil((low_m - first_m) / step_m), 0.0, double{1} * count)),
          static_cast<int64_t>(std::clamp(std::floor((high_m - first_m) / step_m), -1.0, count - 1.0))};
}

void mark(const Map& map, const glm::dvec2& from, const glm::dvec2& to, double half_width_m, std::vector<bool>& on) {
  const glm::dvec2 low = glm::min(from, to) - half_width_m, high = glm::max(from, to) + half_width_m;
  const Numbers x = numbers_between(low.x, high.x, map.first_m.x, map.step_m.x, map.columns);
  const Numbers y = numbers_between(low.y, high.y, map.first_m.y, map.step_m.y, map.rows);
  for (int64_t iy = y.first; iy <= y.last; ++iy)
    for (int64_t ix = x.first; ix <= x.last; ++ix) {
      const size_t cell = static_cast<size_t>(iy) * map.columns + static_cast<size_t>(ix);
      if (distance_m({map.x_m(cell), map.y_m(cell)}, from, to) <= half_width_m) on[cell] = true;
    }
}

}  // namespace

std::vector<bool> cells_on_streets(const Map& map, std::span<const Street> streets) {
  std::vector<bool> out(map.cells.size());
  for (const Street& street : streets)
    for (size_t i = 0; i + 1 < street.centre_m.size(); ++i)
      mark(map, glm::dvec2(street.centre_m[i]), glm::dvec2(street.centre_m[i + 1]), 0.5 * street.width_m, out);
  return out;
}

void keep_streets(Map& map, const std::vector<bool>& on_street) {
  map.only_streets = true;
  for (size_t cell = 0; cell < map.cells.size(); ++cell) {
    if (on_street[cell]) continue;
    map.cells[cell] = {};
    if (!map.chances.empty()) map.chances[cell] = {};
  }
}

}  // namespace wavetracer::coverage
