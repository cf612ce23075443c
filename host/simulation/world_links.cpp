// SPDX-License-Identifier: Apache-2.0
// All pairs of the ends whose names are wanted and that are present, each tested.
// Made for ends of which thousands are present at once: pairs are counted in millions, and limited.
#include "simulation/world_links.hpp"

#include <fmt/format.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "simulation/name_pattern.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t most_pairs = uint64_t{1} << 36;          // 262,144 vehicles with an antenna each
constexpr uint64_t most_present_pairs = uint64_t{1} << 30;  // seconds for the test of their distances

// Throws ConfigError for a pattern that no name matches; names are copied only then, since they may be millions.
void require_ends(const std::vector<std::string>& patterns, const std::vector<RadioEnd>& ends,
                  const std::string& role) {
  for (const std::string& pattern : patterns) {
    if (std::ranges::any_of(ends, [&](const RadioEnd& end) { return matches(pattern, end.name); })) continue;
    std::vector<std::string> names;
    for (const RadioEnd& end : ends) names.push_back(end.name);
    require_match(pattern, names, "links." + role + "s", role);
  }
}

std::vector<uint32_t> wanted(const std::vector<std::string>& patterns, const std::vector<RadioEnd>& ends,
                             const std::string& role) {
  require_ends(patterns, ends, role);
  std::vector<uint32_t> out;
  out.reserve(ends.size());
  for (uint32_t i = 0; i < ends.size(); ++i)
    if (std::ranges::any_of(patterns, [&](const std::string& pattern) { return matches(pattern, ends[i].name); }))
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

LinkSide side_of(const EndsOfRole& role) {
  LinkSide out;
  out.ends = role.ends;
  out.vehicles.assign(role.standing.size(), no_vehicle);
  for (const MountedEnd& end : role.mounted) out.vehicles.push_back(end.track);
  return out;
}

}  // namespace

LinkRules link_rules(const LinksConfig& config, const WorldEnds& ends) {
  return {config, side_of(ends.transmitters), side_of(ends.receivers)};
}

LinkRules::LinkRules(const LinksConfig& config, LinkSide transmitters, LinkSide receivers)
    : config_(config),
      transmitters_(std::move(transmitters)),
      receivers_(std::move(receivers)),
      wanted_transmitters_(wanted(config.transmitters, transmitters_.ends, "transmitter")),
      wanted_receivers_(wanted(config.receivers, receivers_.ends, "receiver")) {
  check_pairs(wanted_transmitters_.size(), wanted_receivers_.size(), most_pairs, "of all frames");
}

bool LinkRules::allowed(uint32_t tx_vehicle, uint32_t rx_vehicle) const {
  if (tx_vehicle == no_vehicle && rx_vehicle == no_vehicle) return config_.i2i;
  if (tx_vehicle == no_vehicle || rx_vehicle == no_vehicle) return config_.v2i;
  return tx_vehicle == rx_vehicle ? config_.same_vehicle : config_.v2v;
}

// Tells whether two ends in one place are one radio, which has one name. It has no link to itself; a receiver at the
// place of a transmitter, under a name of its own, hears the echoes.
bool LinkRules::one_radio(uint32_t tx, uint32_t rx) const {
  return transmitters_.vehicles[tx] == receivers_.vehicles[rx] &&
         transmitters_.ends[tx].name == receivers_.ends[rx].name;
}

bool LinkRules::any_allowed() const {
  return std::ranges::any_of(wanted_transmitters_, [&](uint32_t tx) {
    return std::ranges::any_of(
        wanted_receivers_, [&](uint32_t rx) { return allowed(transmitters_.vehicles[tx], receivers_.vehicles[rx]); });
  });
}

void LinkRules::add_links(uint32_t tx, const EndState& from, const Places& present, std::vector<Link>& out) const {
  const double most_m = config_.max_distance_m, most_square = most_m * most_m * (1 + 1e-12);
  const uint32_t vehicle = transmitters_.vehicles[tx];
  constexpr size_t block = 256;
  std::array<double, block> square;
  for (size_t first = 0; first < present.ends.size(); first += block) {
    const size_t count = std::min(block, present.ends.size() - first);
    for (size_t k = 0; k < count; ++k) {  // no branch a pair, so that compilers use vectors
      const double x = present.x[first + k] - from.position_m.x, y = present.y[first + k] - from.position_m.y;
      const double z = present.z[first + k] - from.position_m.z;
      square[k] = x * x + y * y + z * z;
    }
    for (size_t k = 0; k < count; ++k) {
      if (square[k] > most_square) continue;
      const uint32_t rx = present.ends[first + k];
      if (!allowed(vehicle, receivers_.vehicles[rx]) || std::sqrt(square[k]) > most_m) continue;
      if (square[k] > 0 || !one_radio(tx, rx)) out.push_back({tx, rx});
    }
  }
}

std::vector<Link> LinkRules::operator()(const std::vector<EndState>& transmitters,
                                        const std::vector<EndState>& receivers) const {
  Places present;
  for (const uint32_t rx : wanted_receivers_) {
    if (!receivers[rx].present) continue;
    present.ends.push_back(rx);
    present.x.push_back(receivers[rx].position_m.x);
    present.y.push_back(receivers[rx].position_m.y);
    present.z.push_back(receivers[rx].position_m.z);
  }
  std::vector<uint32_t> sending;
  std::ranges::copy_if(wanted_transmitters_, std::back_inserter(sending),
                       [&](uint32_t tx) { return transmitters[tx].present; });
  check_pairs(sending.size(), present.ends.size(), most_present_pairs, "of one frame");
  // In parts of 128 transmitters, on all cores where there are several.
  constexpr size_t part = 128;
  std::vector<std::vector<Link>> parts((sending.size() + part - 1) / part);
  tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
    for (size_t k = i * part; k < std::min((i + 1) * part, sending.size()); ++k)
      add_links(sending[k], transmitters[sending[k]], present, parts[i]);
  });
  if (parts.size() == 1) return std::move(parts.front());
  std::vector<Link> out;
  for (const std::vector<Link>& links : parts) out.insert(out.end(), links.begin(), links.end());
  return out;
}

}  // namespace wavetracer
