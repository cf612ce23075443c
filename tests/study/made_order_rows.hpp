// SPDX-License-Identifier: Apache-2.0
// Rows as a device would give them, with times that a test chooses.
// All series of one experiment find the same.
#pragma once
#include <functional>
#include <vector>
#include "study/experiment.hpp"

// Seconds that a series takes without and for ordering.
using Cost = std::function<std::pair<double, double>(const wavetracer::study::Series&, uint64_t rays)>;

inline std::vector<wavetracer::study::OrderRow> made_rows(const wavetracer::study::Experiment& experiment,
                                                          const std::vector<uint64_t>& counts, const Cost& cost) {
  using namespace wavetracer::study;
  const OrderFigure& figure = *experiment.as<OrderFigure>();
  std::vector<OrderRow> rows;
  for (const uint64_t rays : counts) {
    std::vector<OrderRow> point;
    for (const Series& series : figure.series) {
      const auto [unpaid, order] = cost(series, rays);
      point.push_back({.rays = rays,
                       .frames = figure.moves ? 20u : 1u,
                       .launched = static_cast<double>(rays),
                       .series = series,
                       .times = {.trace_s = 0.9 * unpaid, .order_s = order, .unpaid_s = unpaid, .frame_s = 2 * unpaid},
                       .paths = 30,
                       .sequences = 1000,
                       .noise_unpaid = 0.001,
                       .noise_paid = 0.001});
    }
    compare(point);
    rows.insert(rows.end(), point.begin(), point.end());
  }
  return rows;
}
