// SPDX-License-Identifier: Apache-2.0
// Pairs are found by the vehicle of their ends, since a fleet may have a radar on each of its vehicles.
#include "simulation/world_radars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "radar/radar_cube.hpp"
#include "simulation/name_pattern.hpp"
#include "wavetracer/arrays.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t most_radar_links = 65536;
constexpr uint64_t most_cells = uint64_t{1} << 26;  // limit for one link, whose cube takes 1 GiB while it is computed

// An end that a radar names.
struct NamedEnd {
  uint32_t end, vehicle;  // no_vehicle: it is fixed
};

// Returns no_vehicle for an end that is fixed.
uint32_t vehicle_of(const EndsOfRole& role, uint32_t end) {
  return end < role.standing.size() ? no_vehicle : role.mounted[end - role.standing.size()].track;
}

std::vector<NamedEnd> named_ends(const std::string& pattern, const EndsOfRole& role, const std::string& key,
                                 const char* what) {
  const std::vector<RadioEnd>& ends = role.ends;
  std::vector<NamedEnd> out;
  for (uint32_t i = 0; i < ends.size(); ++i)
    if (matches(pattern, ends[i].name)) out.push_back({i, vehicle_of(role, i)});
  if (!out.empty()) return out;
  std::vector<std::string> names;
  for (const RadioEnd& end : ends) names.push_back(end.name);
  require_match(pattern, names, key, what);
  return out;
}

void check_number(size_t links, const RadarConfig& radar) {
  if (links > most_radar_links)
    throw ConfigError(
        fmt::format("radar \"{}\" has more than {} pairs of ends: name fewer of them by its transmitter and "
                    "receiver",
                    radar.name, most_radar_links));
}

// The pairs that a radar names, whether or not [links] allows them.
std::vector<Link> named_pairs(const RadarConfig& radar, const std::vector<NamedEnd>& sending,
                              const std::vector<NamedEnd>& hearing) {
  std::vector<Link> out;
  const bool monostatic = radar.kind == "monostatic";
  std::multimap<uint32_t, uint32_t> by_vehicle;
  for (const NamedEnd& rx : hearing) by_vehicle.emplace(rx.vehicle, rx.end);
  for (const NamedEnd& tx : sending) {
    if (monostatic) {
      const auto [first, last] = by_vehicle.equal_range(tx.vehicle);
      for (auto rx = first; rx != last; ++rx) out.push_back({tx.end, rx->second});
    } else {
      for (const NamedEnd& rx : hearing)
        if (tx.vehicle == no_vehicle || tx.vehicle != rx.vehicle) out.push_back({tx.end, rx.end});
    }
    check_number(out.size(), radar);
  }
  std::ranges::sort(out);
  return out;
}

bool names_one_of(const std::vector<std::string>& patterns, const std::string& name) {
  return std::ranges::any_of(patterns, [&](const std::string& pattern) { return matches(pattern, name); });
}

// Returns why [links] leaves out a pair, and what to do; empty if it does not.
std::string left_out_because(const Config& config, const World& world, Link link) {
  const std::string &tx = config.transmitters[link.tx].name, &rx = config.receivers[link.rx].name;
  const uint32_t sender = vehicle_of(world.transmitters, link.tx), hearer = vehicle_of(world.receivers, link.rx);
  const LinksConfig& links = config.links;
  if (sender == hearer && tx == rx)
    return "its transmitter and its receiver are one end, which has no link to itself: give the receiver a name of its "
           "own, by a [[mount]] with the role \"receiver\", or a [[receiver]]";
  if (!names_one_of(links.transmitters, tx)) return "links.transmitters leaves out its transmitter: name it there";
  if (!names_one_of(links.receivers, rx)) return "links.receivers leaves out its receiver: name it there";
  if (sender != no_vehicle && sender == hearer)
    return links.same_vehicle ? "" : "both are on one vehicle: give links.same_vehicle = true";
  if (sender == no_vehicle && hearer == no_vehicle) return links.i2i ? "" : "both are fixed: give links.i2i = true";
  if (sender == no_vehicle || hearer == no_vehicle)
    return links.v2i ? "" : "one is fixed, and the other on a vehicle: give links.v2i = true";
  return links.v2v ? "" : "they are on different vehicles: give links.v2v = true";
}

// Removes the pairs that [links] leaves out. Returns what to say of them; empty if there are none but ends that would
// hear themselves.
std::string remove_left_out(const Config& config, const World& world, const RadarConfig& radar,
                            std::vector<Link>& pairs) {
  std::string first, own;
  size_t count = 0;
  const size_t named = pairs.size();
  std::erase_if(pairs, [&](Link link) {
    const std::string why = left_out_because(config, world, link);
    if (why.empty()) return false;
    const std::string &tx = config.transmitters[link.tx].name, &rx = config.receivers[link.rx].name;
    (tx == rx ? own : first) = fmt::format("the link from \"{}\" to \"{}\" is not computed: {}", tx, rx, why);
    count += tx == rx ? 0 : 1;
    return true;
  });
  if (pairs.empty() && count == 0) return fmt::format("radar \"{}\": {}", radar.name, own);
  if (count == 0) return "";
  return fmt::format("radar \"{}\": {}{}", radar.name,
                     pairs.empty() ? "" : fmt::format("{} of its {} pairs of ends are left out; ", count, named),
                     first);
}

std::vector<Link> computed_pairs(const Config& config, const World& world, const RadarConfig& radar,
                                 std::vector<std::string>& warnings) {
  const std::string key = fmt::format("radar \"{}\": ", radar.name);
  const auto sending = named_ends(radar.transmitter, world.transmitters, key + "transmitter", "transmitter"),
             hearing = named_ends(radar.receiver, world.receivers, key + "receiver", "receiver");
  std::vector<Link> out = named_pairs(radar, sending, hearing);
  if (out.empty())
    throw ConfigError(fmt::format(
        "{}no pair of its ends is {}: {}", key, radar.kind.word(),
        radar.kind == "monostatic"
            ? "give a transmitter and a receiver on one vehicle, or two that are fixed, or kind = \"bistatic\""
            : "all of them are on one vehicle: give kind = \"monostatic\", or name ends of two vehicles"));
  const std::string left_out = remove_left_out(config, world, radar, out);
  if (out.empty()) throw ConfigError(left_out);
  if (!left_out.empty()) warnings.push_back(left_out);
  return out;
}

uint32_t antennas_of(const Config& config, const RadioEnd& end) {
  return static_cast<uint32_t>(element_positions_m(config, end).size()) * ports_of(end.polarization);
}

RadarAxes axes_of(const Config& config, const RadarConfig& radar, const std::vector<Link>& links) {
  const auto antennas = [&](Link link) {
    return std::pair(antennas_of(config, config.receivers[link.rx]), antennas_of(config, config.transmitters[link.tx]));
  };
  const auto [rx, tx] = antennas(links.front());
  for (const Link& link : links)
    if (antennas(link) != std::pair(rx, tx))
      throw ConfigError(fmt::format(
          "radar \"{}\": the ends of \"{}\" and \"{}\" have other numbers of antennas than those of \"{}\" and \"{}\": give "
          "each kind a [[radar]] of its own",
          radar.name, config.transmitters[link.tx].name, config.receivers[link.rx].name,
          config.transmitters[links.front().tx].name, config.receivers[links.front().rx].name));
  if (radar.turns && tx == 1)
    throw ConfigError(
        fmt::format("radar \"{}\": turns = true has no effect, since its transmitter has one antenna: "
                    "remove turns, or give the transmitter an [[array]]",
                    radar.name));
  const uint64_t cells = uint64_t{rx} * tx * radar.chirps * radar.samples;
  if (cells > most_cells)
    throw ConfigError(fmt::format(
        "radar \"{}\": its cube has {} x {} antennas, {} chirps and {} samples, {} cells, and {} are the limit: give fewer "
        "antennas, chirps or samples",
        radar.name, rx, tx, radar.chirps, radar.samples, cells, most_cells));
  return radar_axes(radar, rx, tx, config.radio.frequency_hz);
}

}  // namespace

std::vector<WorldRadar> world_radars(const Config& config, const World& world, std::vector<std::string>& warnings) {
  std::vector<WorldRadar> out;
  for (const RadarConfig& radar : config.radars) {
    std::vector<Link> links = computed_pairs(config, world, radar, warnings);
    out.push_back({axes_of(config, radar, links), std::move(links)});
  }
  return out;
}

std::vector<Link> links_in(const WorldRadar& radar, const std::vector<Link>& present) {
  std::vector<Link> out;
  std::ranges::set_intersection(radar.links, present, std::back_inserter(out));
  return out;
}

}  // namespace wavetracer
