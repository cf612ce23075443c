// Rows as a device would give them, with times that a test chooses.
// All series of one recipe find the same.
#pragma once
#include <functional>
#include <vector>
#include "study/recipe.hpp"

// Seconds that a series takes without and for ordering.
using Cost = std::function<std::pair<double, double>(const wavetracer::study::Series&, uint64_t rays)>;

inline std::vector<wavetracer::study::Row> made_rows(const wavetracer::study::Recipe& recipe,
                                                     const std::vector<uint64_t>& counts, const Cost& cost) {
  using namespace wavetracer::study;
  std::vector<Row> rows;
  for (const uint64_t rays : counts) {
    std::vector<Row> point;
    for (const Series& series : recipe.series) {
      const auto [unpaid, order] = cost(series, rays);
      point.push_back({.rays = rays,
                       .frames = recipe.frames,
                       .series = series,
                       .times = {.trace_s = 0.9 * unpaid, .order_s = order, .unpaid_s = unpaid, .frame_s = 2 * unpaid},
                       .paths = 30,
                       .sequences = 1000});
    }
    compare(point);
    rows.insert(rows.end(), point.begin(), point.end());
  }
  return rows;
}
