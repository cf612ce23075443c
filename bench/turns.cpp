// SPDX-License-Identifier: Apache-2.0
// Measures with a steady clock around Simulation::run_frame, as frames.cpp does.
// Quartiles are interpolated between ranks.
#include "turns.hpp"

#include <algorithm>
#include <cmath>

#include "timing.hpp"

namespace wavetracer::bench {
namespace {

// q is from 0 to 1; values must not be empty.
double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double rank = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(rank);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

std::vector<Turns> run_in_turn(const Config& common, const std::vector<Variant>& variants, const std::string& device,
                               size_t rounds) {
  std::vector<Simulation> simulations;
  for (const Variant& variant : variants) {
    Config config = common;
    variant.change(config);
    simulations.emplace_back(config, device).run_frame(0);
  }
  std::vector<Turns> turns(variants.size());
  std::vector<std::vector<double>> seconds(variants.size()), costs(variants.size());
  for (size_t round = 0; round < rounds; round++)
    for (size_t i = 0; i < variants.size(); i++) {
      seconds[i].push_back(wall_seconds([&] {
        simulations[i].give_back(turns[i].result);
        turns[i].result = simulations[i].run_frame(0);
      }));
      costs[i].push_back(seconds[i].back() / seconds[0].back());
    }
  for (size_t i = 0; i < variants.size(); i++) {
    turns[i].median_s = quantile(seconds[i], 0.5);
    turns[i].cost = quantile(costs[i], 0.5);
    turns[i].cost_error =
        1.57 * (quantile(costs[i], 0.75) - quantile(costs[i], 0.25)) / std::sqrt(static_cast<double>(rounds));
    turns[i].features = simulations[i].features();
    turns[i].device = simulations[i].device().name;
  }
  return turns;
}

}  // namespace wavetracer::bench
