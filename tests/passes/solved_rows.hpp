// SPDX-License-Identifier: Apache-2.0
// Solved paths that a test writes itself, and the surfaces that their legs pass, by brute force: double, every
// triangle. Row i goes from transmitter i to receiver i.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "passes/on_device.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer::test {

struct PathRow {
  glm::dvec3 from{0}, to{0};
  std::vector<uint32_t> steps;  // as wt_solved has them: WT_STEP_KIND and a number
  std::vector<glm::dvec3> points;
  bool blocked = false;
  uint32_t from_instance = no_instance, to_instance = no_instance;
};

inline RadioEnds ends_of(const std::vector<PathRow>& rows) {
  std::vector<EndState> tx(rows.size()), rx(rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    tx[i].position_m = rows[i].from;
    tx[i].instance = rows[i].from_instance;
    rx[i].position_m = rows[i].to;
    rx[i].instance = rows[i].to_instance;
  }
  return make_radio_ends(context(), tx, rx, {});
}

inline SolvedList upload_rows(const std::vector<PathRow>& rows, uint32_t max_depth) {
  SolvedList list;
  list.max_depth = max_depth;
  list.count = static_cast<uint32_t>(rows.size());
  list.reserve(context(), rows.size());
  std::vector<wt_solved> headers;
  std::vector<double> vertices(3 * rows.size() * max_depth, NAN);
  std::vector<uint32_t> steps(rows.size() * max_depth, WT_NONE);
  for (uint32_t i = 0; i < rows.size(); ++i) {
    headers.push_back({i, i, static_cast<uint32_t>(rows[i].steps.size()), 0, WT_ROOT | i, WT_ALL_QUARTERS});
    for (size_t k = 0; k < rows[i].steps.size(); ++k) {
      steps[i * max_depth + k] = rows[i].steps[k];
      for (int axis = 0; axis < 3; ++axis)
        vertices[3 * (i * max_depth + k) + static_cast<size_t>(axis)] = rows[i].points[k][axis];
    }
  }
  list.headers.write(headers);
  list.vertices.write(vertices);
  list.sequences.write(steps);
  return list;
}

// Returns rows in the order of the list. It does not know the ends, which stay at the origin.
inline std::vector<PathRow> download_rows(const SolvedList& list) {
  std::vector<PathRow> rows;
  if (list.count == 0) return rows;
  const auto steps = list.sequences.read(0, size_t{list.count} * list.max_depth);
  const auto xyz = list.vertices.read(0, 3 * steps.size());
  for (const wt_solved& header : list.headers.read(0, list.count)) {
    PathRow row;
    row.blocked = header.blocked != 0;
    for (size_t k = rows.size() * list.max_depth; row.steps.size() < header.depth; ++k) {
      row.steps.push_back(steps[k]);
      row.points.emplace_back(xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]);
    }
    rows.push_back(row);
  }
  return rows;
}

struct Crossing {
  uint32_t surface;
  glm::dvec3 point;
};

// Returns the surfaces between two points, in order, if nothing touches: those with both points farther than 0.1 mm
// from their plane, on opposite sides, but not `source` and `goal`. If several lie in one place and plane, the first of
// the scene stays.
inline std::vector<Crossing> crossings(const Scene& scene, const glm::dvec3& from, const glm::dvec3& to,
                                       uint32_t source = WT_NONE, uint32_t goal = WT_NONE) {
  std::vector<Crossing> out;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const uint32_t number = scene.triangle_surface[t];
    const Surface& surface = scene.surfaces[number];
    const double a = glm::dot(surface.normal, from) - surface.offset_m;
    const double b = glm::dot(surface.normal, to) - surface.offset_m;
    if (number == source || number == goal || a * b >= 0 || std::min(std::abs(a), std::abs(b)) <= 1e-4) continue;
    const glm::dvec3 point = from + (to - from) * (a / (a - b));
    glm::dvec3 v[3];
    for (size_t k = 0; k < 3; ++k) v[k] = scene.vertices[scene.triangles[t][k]];
    const glm::dvec3 area = glm::cross(v[1] - v[0], v[2] - v[0]);
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 part = glm::cross(v[(k + 1) % 3] - v[k], point - v[k]);
      inside = inside && glm::dot(area, part) >= -1e-12 * glm::dot(area, area);
    }
    const auto same = [&](const Crossing& c) {
      const double cosine = glm::dot(scene.surfaces[c.surface].normal, surface.normal);
      return glm::distance(c.point, point) < 1e-4 && std::abs(cosine) > 0.9999;
    };
    if (inside && std::ranges::none_of(out, same)) out.push_back({number, point});
  }
  std::ranges::stable_sort(out, {}, [&](const Crossing& c) { return glm::distance(from, c.point); });
  return out;
}

// Returns the row with the surfaces that its legs pass.
inline PathRow with_crossings(const Scene& scene, const PathRow& row) {
  PathRow out = row;
  out.steps.clear();
  out.points.clear();
  const auto reflecting = [](uint32_t step) { return (step & WT_STEP_KIND) == WT_STEP_REFLECTION ? step : WT_NONE; };
  for (size_t leg = 0; leg <= row.steps.size(); ++leg) {
    const bool first = leg == 0, last = leg == row.steps.size();
    for (const Crossing& c :
         crossings(scene, first ? row.from : row.points[leg - 1], last ? row.to : row.points[leg],
                   first ? WT_NONE : reflecting(row.steps[leg - 1]), last ? WT_NONE : reflecting(row.steps[leg]))) {
      out.steps.push_back(WT_STEP_TRANSMISSION | c.surface);
      out.points.push_back(c.point);
    }
    if (last) break;
    out.steps.push_back(row.steps[leg]);
    out.points.push_back(row.points[leg]);
  }
  return out;
}

}  // namespace wavetracer::test
