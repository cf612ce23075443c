// Reads solved paths, drops the obstructed, sorts and merges.
// A few thousand paths: plain host code.
#include "simulation/visible_paths.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "wavetracer/paths.hpp"

namespace wavetracer {

namespace {

struct Row {
  wt_solved header;
  std::span<const uint32_t> surfaces;
  std::span<const double> vertices;  // three a surface
};

bool same_path(const Row& a, const Row& b) {
  if (a.header.transmitter != b.header.transmitter || a.header.receiver != b.header.receiver ||
      a.header.depth != b.header.depth)
    return false;
  return std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(),
                    [](double x, double y) { return std::abs(x - y) <= merge_distance_m; });
}

// Drops every row that equals an earlier one. Rows of one link and depth are compared through their first vertex's x.
std::vector<Row> merged(std::vector<Row> rows) {
  std::vector<size_t> by_x(rows.size());
  std::iota(by_x.begin(), by_x.end(), size_t{0});
  const auto x = [&](size_t i) { return rows[i].header.depth ? rows[i].vertices[0] : 0.0; };
  const auto link = [&](size_t i) {
    return std::tuple(rows[i].header.transmitter, rows[i].header.receiver, rows[i].header.depth);
  };
  std::sort(by_x.begin(), by_x.end(),
            [&](size_t i, size_t j) { return std::tuple(link(i), x(i), i) < std::tuple(link(j), x(j), j); });
  std::vector<char> dropped(rows.size(), 0);
  for (size_t a = 0; a < by_x.size(); ++a)
    for (size_t b = a + 1;
         b < by_x.size() && link(by_x[a]) == link(by_x[b]) && x(by_x[b]) - x(by_x[a]) <= merge_distance_m; ++b)
      if (same_path(rows[by_x[a]], rows[by_x[b]])) dropped[std::max(by_x[a], by_x[b])] = 1;
  std::vector<Row> out;
  for (size_t i = 0; i < rows.size(); ++i)
    if (!dropped[i]) out.push_back(rows[i]);
  return out;
}

}  // namespace

PathGeometry visible_paths(const SolvedList& solved) {
  PathGeometry out;
  if (solved.count == 0) return out;
  const size_t stride = solved.max_depth;
  const auto headers = solved.headers.read(0, solved.count);
  const auto vertices = solved.vertices.read(0, 3 * stride * solved.count);
  const auto sequences = solved.sequences.read(0, stride * solved.count);
  std::vector<Row> rows;
  for (size_t i = 0; i < headers.size(); ++i)
    if (!headers[i].blocked)
      rows.push_back({headers[i], std::span(sequences).subspan(i * stride, headers[i].depth),
                      std::span(vertices).subspan(3 * i * stride, 3 * headers[i].depth)});
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    const auto key = [](const Row& r) { return std::tuple(r.header.transmitter, r.header.receiver, r.header.depth); };
    if (key(a) != key(b)) return key(a) < key(b);
    return std::lexicographical_compare(a.surfaces.begin(), a.surfaces.end(), b.surfaces.begin(), b.surfaces.end());
  });
  for (const Row& row : merged(std::move(rows))) {
    out.tx.push_back(row.header.transmitter);
    out.rx.push_back(row.header.receiver);
    for (uint32_t k = 0; k < row.header.depth; ++k) {
      out.surface.push_back(row.surfaces[k]);
      out.interaction.push_back(Interaction::reflection);
      out.vertex.emplace_back(row.vertices[3 * k], row.vertices[3 * k + 1], row.vertices[3 * k + 2]);
    }
    out.first.push_back(out.surface.size());
  }
  return out;
}

}  // namespace wavetracer
