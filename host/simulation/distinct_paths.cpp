// Sorts and merges paths link by link, links in parallel, then writes every row to its place.
#include "simulation/distinct_paths.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <span>
#include <tuple>

#include "radio/link_groups.hpp"
#include "radio/path_rows.hpp"

namespace wavetracer {

namespace {

std::strong_ordering compare_sequences(const PathGeometry& paths, uint32_t a, uint32_t b) {
  const auto depth = [&](uint32_t path) { return paths.first[path + 1] - paths.first[path]; };
  const auto compare = [&](const auto& column) {
    const auto x = of_path(paths, column, a), y = of_path(paths, column, b);
    return std::lexicographical_compare_three_way(x.begin(), x.end(), y.begin(), y.end());
  };
  if (const auto order = depth(a) <=> depth(b); order != 0) return order;
  if (const auto order = compare(paths.surface); order != 0) return order;
  return compare(paths.interaction);
}

// Where a point of reflection comes near an edge, the diffraction there is another path.
bool one_path(const PathGeometry& paths, uint32_t a, uint32_t b) {
  if (!std::ranges::equal(of_path(paths, paths.interaction, a), of_path(paths, paths.interaction, b))) return false;
  const auto x = of_path(paths, paths.vertex, a), y = of_path(paths, paths.vertex, b);
  return std::ranges::equal(x, y, [](const glm::dvec3& p, const glm::dvec3& q) {
    return std::abs(p.x - q.x) <= merge_distance_m && std::abs(p.y - q.y) <= merge_distance_m &&
           std::abs(p.z - q.z) <= merge_distance_m;
  });
}

// Sorts the rows of one link, moves those that differ from every earlier one to the front, and returns their number.
// What the others were found by, those that stay were found by, too. Rows of one depth are compared through their first
// vertex's x.
size_t keep_distinct(const PathGeometry& paths, std::span<uint32_t> rows, std::vector<uint8_t>& quarters) {
  std::ranges::sort(rows, [&](uint32_t a, uint32_t b) {
    const auto order = compare_sequences(paths, a, b);
    return order != 0 ? order < 0 : a < b;
  });
  struct Place {
    uint64_t depth;
    double x;
    uint32_t at;  // in rows
    bool near(const Place& next) const { return depth == next.depth && next.x - x <= merge_distance_m; }
  };
  std::vector<Place> by_x(rows.size());
  for (uint32_t at = 0; at < rows.size(); ++at) {
    const auto points = of_path(paths, paths.vertex, rows[at]);
    by_x[at] = {points.size(), points.empty() ? 0.0 : points[0].x, at};
  }
  std::ranges::sort(by_x, {}, [](const Place& p) { return std::tuple(p.depth, p.x, p.at); });
  std::vector<uint32_t> same(rows.size());  // the first that each is the same as
  std::iota(same.begin(), same.end(), 0);
  for (uint32_t at = 1; at < rows.size(); ++at)
    if (compare_sequences(paths, rows[at - 1], rows[at]) == 0) same[at] = at - 1;
  for (size_t a = 0; a < by_x.size(); ++a)
    for (size_t b = a + 1; b < by_x.size() && by_x[a].near(by_x[b]); ++b)
      if (one_path(paths, rows[by_x[a].at], rows[by_x[b].at])) {
        const auto [first, second] = std::minmax(by_x[a].at, by_x[b].at);
        same[second] = std::min(same[second], first);
      }
  if (!quarters.empty())
    for (size_t at = rows.size(); at-- > 0;) quarters[rows[same[at]]] |= quarters[rows[at]];
  size_t kept = 0;
  for (size_t at = 0; at < rows.size(); ++at)
    if (same[at] == at) rows[kept++] = rows[at];
  return kept;
}

}  // namespace

PathGeometry distinct_paths(const PathGeometry& found) {
  LinkGroups links = group_by_link(found.tx, found.rx);
  std::vector<uint8_t> quarters = found.quarters;
  std::vector<size_t> kept(links.size());
  tbb::parallel_for(size_t{0}, links.size(),
                    [&](size_t link) { kept[link] = keep_distinct(found, links.rows(link), quarters); });
  std::vector<uint32_t> rows;
  rows.reserve(found.size());
  for (size_t link = 0; link < links.size(); ++link) {
    const auto of_link = links.rows(link).first(kept[link]);
    rows.insert(rows.end(), of_link.begin(), of_link.end());
  }
  PathGeometry out = rows_of(found, rows);
  for (size_t i = 0; i < out.quarters.size(); ++i) out.quarters[i] = quarters[rows[i]];
  return out;
}

}  // namespace wavetracer
