// SPDX-License-Identifier: Apache-2.0
// Receptions of a batch are grouped by node and receiver. The nearest of each group is compared with those of other
// batches by its surfaces, since nodes get new numbers when the set of sequences grows.
#include "simulation/sphere_reception.hpp"

#include <algorithm>

#include "wavetracer/paths.hpp"

namespace wavetracer {

namespace {

// The nearest reception of each node and receiver; of equals the one with the lowest sample, then the lowest depth.
std::vector<wt_reception> nearest(std::vector<wt_reception> found) {
  std::ranges::sort(
      found, {}, [](const wt_reception& r) { return std::tuple(r.node, r.receiver, r.distance_m, r.sample, r.depth); });
  const auto repeated =
      std::ranges::unique(found, {}, [](const wt_reception& r) { return std::pair(r.node, r.receiver); });
  found.erase(repeated.begin(), repeated.end());
  return found;
}

}  // namespace

void SphereReception::begin_launch() {
  kept_.clear();
  count_ = 0;
}

std::vector<wt_reception> SphereReception::end_batch(Waypoints& waypoints) {
  std::vector<wt_reception> all = receive_.list();
  count_ += all.size();
  const std::vector<wt_reception> candidates = nearest(all);
  std::vector<uint32_t> samples;
  for (const wt_reception& r : candidates) samples.push_back(r.sample);
  const std::vector<wt_waypoint> rows = waypoints.rows(samples);
  for (size_t i = 0; i < candidates.size(); ++i) {
    const wt_reception& r = candidates[i];
    const wt_waypoint* row = &rows[i * waypoints.stride()];
    Key key{r.transmitter, r.receiver, {}};
    Kept kept{r.distance_m, {}};
    for (uint32_t k = 1; k <= r.depth; ++k) {
      std::get<2>(key).push_back(row[k].surface);
      kept.points.emplace_back(row[k].position[0], row[k].position[1], row[k].position[2]);
    }
    const auto [at, is_new] = kept_.try_emplace(std::move(key), kept);
    if (!is_new && kept.distance_m < at->second.distance_m) at->second = std::move(kept);
  }
  return all;
}

PathGeometry SphereReception::paths() const {
  PathGeometry out;
  for (const auto& [key, kept] : kept_) {
    const auto& [transmitter, receiver, surfaces] = key;
    out.tx.push_back(transmitter);
    out.rx.push_back(receiver);
    out.surface.insert(out.surface.end(), surfaces.begin(), surfaces.end());
    out.vertex.insert(out.vertex.end(), kept.points.begin(), kept.points.end());
    out.first.push_back(out.surface.size());
  }
  out.interaction.assign(out.surface.size(), Interaction::reflection);
  return out;
}

}  // namespace wavetracer
