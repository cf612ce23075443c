// SPDX-License-Identifier: Apache-2.0
// Rows of one ray follow each other, sorted by depth.
// Colours are those of the page: the first segments are the darkest.
#include "plots/rays_plot.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <map>
#include "base/csv.hpp"
#include "plots/coverage_plot.hpp"

namespace wavetracer::plots {
namespace {

bool is_hit(WaypointKind kind) { return kind == WaypointKind::reflection || kind == WaypointKind::diffraction; }

std::string segment_table(const std::vector<RaySegment>& segments) {
  Csv table({"x0_m", "y0_m", "x1_m", "y1_m", "segment", "source"});
  for (const RaySegment& s : segments) table.add(s.x0, s.y0, s.x1, s.y1, s.number, static_cast<int>(s.source));
  return table.text();
}

std::string centroid_table(const std::vector<RayCentroid>& centroids) {
  Csv table({"segment", "hits", "answered", "x_m", "y_m", "z_m"});
  for (const RayCentroid& c : centroids)
    table.add(c.number, c.hits, c.answered, c.position_m.x, c.position_m.y, c.position_m.z);
  return table.text();
}

}  // namespace

std::vector<RaySegment> ray_segments(const WaypointRows& rows, size_t step) {
  std::vector<RaySegment> out;
  size_t launches = 0;
  glm::dvec3 last_m{0};
  for (size_t i = 0; i < rows.size(); ++i) {
    const glm::dvec3& p = rows.position_m[i];
    if (rows.kind[i] == WaypointKind::launch) ++launches;
    if (is_hit(rows.kind[i]) && (launches - 1) % step == 0)
      out.push_back({last_m.x, last_m.y, p.x, p.y, rows.depth[i], rows.source[i]});
    if (rows.kind[i] != WaypointKind::hit) last_m = p;
  }
  return out;
}

std::vector<RayCentroid> ray_centroids(const WaypointRows& rows) {
  std::map<uint32_t, RayCentroid> found;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!is_hit(rows.kind[i])) continue;
    RayCentroid& at = found[rows.depth[i]];
    ++at.hits;
    at.answered += rows.source[i] == WaypointSource::cache;
    at.position_m += rows.position_m[i];
  }
  std::vector<RayCentroid> out;
  for (auto& [number, at] : found) {
    at.number = number;
    at.position_m /= static_cast<double>(at.hits);
    out.push_back(at);
  }
  return out;
}

Figure rays_figure(const WaypointRows& rows, const std::string& when, const Scene& scene) {
  const size_t all = ray_segments(rows, 1).size(),
               step = std::max<size_t>((all + most_segments - 1) / most_segments, 1);
  const std::vector<RaySegment> segments = ray_segments(rows, step);
  const std::string part = step == 1 ? "" : fmt::format(", one of every {}", step);
  const std::string walls = wall_table(section(scene, rows.position_m.front().z));
  Figure out{"rays",
             fmt::format("Sampled rays{}{}", when, part),
             {{"rays.csv", segment_table(segments)},
              {"rays_centroids.csv", centroid_table(ray_centroids(rows))},
              {"rays_walls.csv", walls}},
             ""};
  out.commands =
      "set size ratio -1\n"
      "set border 15\n"
      "unset grid\n"
      "set xlabel 'x (m)'\n"
      "set ylabel 'y (m)'\n"
      "set cblabel 'segment of the ray'\n"
      "set palette negative\n"
      "set cbtics 1\n"
      "set key outside bottom center\n"
      "plot ";
  if (std::ranges::count(walls, '\n') > 1)
    out.commands +=
        "'rays_walls.csv' using 1:2:($3 - $1):($4 - $2) with vectors nohead linecolor '#333333' linewidth 0.6 notitle, "
        "\\\n  ";
  out.commands +=
      "'rays.csv' using 1:2:($3 - $1):($4 - $2):5 with vectors nohead linecolor palette linewidth 0.5 notitle, \\\n"
      "  'rays_centroids.csv' using 4:5 with points pointtype 7 pointsize 1.6 linecolor '#ffffff' notitle, \\\n"
      "  '' using 4:5:1 with points pointtype 7 pointsize 1.2 linecolor palette title 'centroid of the hits of a "
      "segment'\n";
  out.height_px = 760;
  return out;
}

}  // namespace wavetracer::plots
