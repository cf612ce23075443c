// SPDX-License-Identifier: Apache-2.0
// Height differences are counted in half octaves and their shares in eighths. So tables depend only on numbers of
// links, not on their order, and there are few: launchers share them, and so do frames.
#include "simulation/launch_slopes.hpp"

#include <algorithm>
#include <cmath>

namespace wavetracer {

namespace {

// A ray still meets a wall if it is this much too high or too low.
constexpr double least_height_m = 2;
constexpr double half_octave = 1.4142135623730951;
// Rays within this slope of the horizon suffice for scenes of any size: longer paths would have some kilometres.
constexpr double least_z0 = 1.0 / 300;
// This share is for roofs, bridges and other things above or below. In munich a tenth loses paths of an antenna on a
// roof, and half costs twice the rays on streets (docs/method.md).
constexpr double uniform_share = 0.25;
constexpr uint32_t eighths = 8;
constexpr size_t most_tables = 4096;  // tables that are remembered

uint32_t bin_of(double height_m) {
  uint32_t bin = 0;
  for (double next = least_height_m * half_octave; height_m >= next && bin + 1 < SlopeCounts::bins; next *= half_octave)
    ++bin;
  return bin;
}

// Counts a path between these heights above the ground: straight, or by way of the ground.
void count(double from_m, double to_m, SlopeCounts& counts) {
  const double rise = to_m - from_m;
  if (std::abs(rise) < least_height_m) {
    ++counts.up[0];
    ++counts.down[0];
  } else {
    (rise > 0 ? counts.up : counts.down)[bin_of(std::abs(rise))] += 2;
  }
  counts.down[bin_of(from_m + to_m)] += 2;
}

// The shares of the whole; each that is not zero gets at least one eighth.
SlopeCounts in_eighths(const SlopeCounts& counts) {
  uint64_t sum = 0;
  for (uint32_t bin = 0; bin < SlopeCounts::bins; ++bin) sum += uint64_t{counts.up[bin]} + counts.down[bin];
  SlopeCounts out;
  for (uint32_t bin = 0; bin < SlopeCounts::bins && sum > 0; ++bin) {
    out.up[bin] = static_cast<uint32_t>((uint64_t{counts.up[bin]} * eighths + sum - 1) / sum);
    out.down[bin] = static_cast<uint32_t>((uint64_t{counts.down[bin]} * eighths + sum - 1) / sum);
  }
  return out;
}

std::vector<float> table_of(const SlopeCounts& counts, double reach_m) {
  std::vector<HeightShare> shares;
  double height_m = least_height_m;
  for (uint32_t bin = 0; bin < SlopeCounts::bins; ++bin, height_m *= half_octave) {
    const double z0 = std::max(height_m < reach_m ? height_m / reach_m : 1.0, least_z0);
    if (counts.up[bin] > 0) shares.push_back({static_cast<double>(counts.up[bin]), z0, true});
    if (counts.down[bin] > 0) shares.push_back({static_cast<double>(counts.down[bin]), z0, false});
  }
  return height_table(shares, uniform_share);
}

// The height of the lowest surface straight below; that of the floor of the scene's box if there is none.
double lowest_below(const Surroundings& around, const glm::dvec3& place) {
  const Scene& scene = around.scene();
  double lowest = place.z;
  for (const auto& crossing : around.crossings(place, {place.x, place.y, scene.lower.z - 1})) {
    const Surface& surface = scene.surfaces[scene.triangle_surface[crossing.triangle]];
    const double z = (surface.offset_m - surface.normal.x * place.x - surface.normal.y * place.y) / surface.normal.z;
    lowest = std::min(lowest, z);
  }
  return lowest < place.z ? lowest : std::min(scene.lower.z, place.z);
}

}  // namespace

LaunchSlopes::LaunchSlopes(const Surroundings& around, double reach_m)
    : around_(around),
      reach_m_(std::max(reach_m, std::hypot(around.scene().upper.x - around.scene().lower.x,
                                            around.scene().upper.y - around.scene().lower.y))) {}

double LaunchSlopes::ground_m(uint32_t origin, const EndState& end, const WorldState& world) {
  if (end.instance != no_instance) return std::min(world.instances[end.instance].position_m.z, end.position_m.z);
  if (origin == no_end) return end.position_m.z;
  if (origin >= ground_.size()) ground_.resize(origin + 1);
  Ground& known = ground_[origin];
  if (known.position_m != end.position_m) known = {end.position_m, lowest_below(around_, end.position_m)};
  return known.height_m;
}

SlopeTables LaunchSlopes::tables(const WorldState& world, const Origins& origins) {
  std::vector<SlopeCounts> counts(origins.count());
  for (const Link& link : world.links) {
    const EndState &tx = world.transmitters[link.tx], &rx = world.receivers[link.rx];
    const uint32_t listener = origins.origin_of_receiver[link.rx];
    const double ground = std::min(ground_m(link.tx, tx, world), ground_m(listener, rx, world));
    count(tx.position_m.z - ground, rx.position_m.z - ground, counts[link.tx]);
    if (listener != no_end) count(rx.position_m.z - ground, tx.position_m.z - ground, counts[listener]);
  }
  SlopeTables out;
  if (known_.size() > most_tables) known_.clear(), values_.clear();
  for (const SlopeCounts& of : counts) {
    const auto [table, added] = known_.emplace(in_eighths(of), static_cast<uint32_t>(known_.size()));
    out.of_origin.push_back(table->second);
    if (!added) continue;
    const std::vector<float> values = table_of(table->first, reach_m_);
    values_.insert(values_.end(), values.begin(), values.end());
  }
  out.values = values_;
  return out;
}

}  // namespace wavetracer
