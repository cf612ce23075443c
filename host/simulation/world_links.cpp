// All pairs of the ends whose names are wanted and that are present, each tested.
// Made for ends of which thousands are present at once: pairs are counted in millions, and limited.
#include "simulation/world_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/name_pattern.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t most_pairs = uint64_t{1} << 36;          // 262,144 vehicles with an antenna each
constexpr uint64_t most_present_pairs = uint64_t{1} << 30;  // seconds for the test of their distances

std::vector<uint32_t> wanted(const std::vector<std::string>& patterns, const std::vector<std::string>& names,
                             const std::string& role) {
  for (const std::string& pattern : patterns) require_match(pattern, names, "links." + role + "s", role);
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < names.size(); ++i)
    if (std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) { return matches(pattern, names[i]); }))
      out.push_back(i);
  return out;
}

void check_pairs(size_t transmitters, size_t receivers, uint64_t most, const char* where) {
  if (uint64_t{transmitters} * receivers <= most) return;
  throw RuntimeError(
      fmt::format("{} transmitters and {} receivers {} are more than {} pairs, the limit: mount antennas on "
                  "fewer vehicles, name fewer of them in links.transmitters and links.receivers, or take "
                  "a part of the trajectories",
                  transmitters, receivers, where, most));
}

}  // namespace

LinkRules::LinkRules(const LinksConfig& config, LinkSide transmitters, LinkSide receivers)
    : config_(config),
      transmitters_(std::move(transmitters)),
      receivers_(std::move(receivers)),
      wanted_transmitters_(wanted(config.transmitters, transmitters_.names, "transmitter")),
      wanted_receivers_(wanted(config.receivers, receivers_.names, "receiver")) {
  check_pairs(wanted_transmitters_.size(), wanted_receivers_.size(), most_pairs, "of all frames");
}

bool LinkRules::allowed(uint32_t tx_vehicle, uint32_t rx_vehicle) const {
  if (tx_vehicle == no_vehicle && rx_vehicle == no_vehicle) return config_.i2i;
  if (tx_vehicle == no_vehicle || rx_vehicle == no_vehicle) return config_.v2i;
  return tx_vehicle == rx_vehicle ? config_.same_vehicle : config_.v2v;
}

bool LinkRules::any_allowed() const {
  return std::ranges::any_of(wanted_transmitters_, [&](uint32_t tx) {
    return std::ranges::any_of(
        wanted_receivers_, [&](uint32_t rx) { return allowed(transmitters_.vehicles[tx], receivers_.vehicles[rx]); });
  });
}

std::vector<Link> LinkRules::operator()(const std::vector<EndState>& transmitters,
                                        const std::vector<EndState>& receivers) const {
  std::vector<uint32_t> present;
  std::copy_if(wanted_receivers_.begin(), wanted_receivers_.end(), std::back_inserter(present),
               [&](uint32_t rx) { return receivers[rx].present; });
  const auto sending =
      std::ranges::count_if(wanted_transmitters_, [&](uint32_t tx) { return transmitters[tx].present; });
  check_pairs(static_cast<size_t>(sending), present.size(), most_present_pairs, "of one frame");
  // A pair farther apart than the most along one axis is passed over before its distance is known.
  std::vector<glm::dvec3> at;
  for (const uint32_t rx : present) at.push_back(receivers[rx].position_m);
  const double most_m = config_.max_distance_m;
  std::vector<Link> out;
  for (const uint32_t tx : wanted_transmitters_) {
    if (!transmitters[tx].present) continue;
    const glm::dvec3& from = transmitters[tx].position_m;
    const uint32_t vehicle = transmitters_.vehicles[tx];
    for (size_t k = 0; k < present.size(); ++k) {
      const glm::dvec3 apart = glm::abs(at[k] - from);
      if (apart.x > most_m || apart.y > most_m || !allowed(vehicle, receivers_.vehicles[present[k]])) continue;
      const double distance_m = glm::length(apart);
      // What an antenna on a vehicle sends to itself is no link; a receiver at a transmitter hears its echoes.
      const bool itself = distance_m == 0 && vehicle != no_vehicle && vehicle == receivers_.vehicles[present[k]];
      if (!itself && distance_m <= most_m) out.push_back({tx, present[k]});
    }
  }
  return out;
}

}  // namespace wavetracer
