// SPDX-License-Identifier: Apache-2.0
// Squares are counted from the lowest corner of all receivers, so that the cells of a grid are divided evenly.
#include "simulation/listeners.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "simulation/world.hpp"
#include "wavetracer/device/moving.h"

namespace wavetracer {
namespace {

constexpr double most_squares = 1 << 24;

// Without listeners. The squares begin a little before the first receivers, so that those on a border are surely in one
// of them.
ListenerSquares squares_around(std::span<const EndState> receivers, double size_m) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low(infinity), high(-infinity);
  for (const EndState& end : receivers) low = glm::min(low, end.position_m), high = glm::max(high, end.position_m);
  const glm::dvec3 extent = high - low;
  ListenerSquares out;
  out.size_m = std::max({size_m, std::sqrt(extent.x * extent.y / most_squares), std::max(extent.x, extent.y) / 1e6});
  out.x_m = low.x - 1e-3 * out.size_m;
  out.y_m = low.y - 1e-3 * out.size_m;
  out.columns = static_cast<uint32_t>((high.x - out.x_m) / out.size_m) + 1;
  out.rows = static_cast<uint32_t>((high.y - out.y_m) / out.size_m) + 1;
  out.low_m = static_cast<float>(low.z);
  out.high_m = static_cast<float>(high.z);
  return out;
}

}  // namespace

Origins make_origins(const std::vector<uint32_t>& receiver_of_transmitter,
                     const std::vector<uint32_t>& transmitter_of_receiver, bool both) {
  Origins out{receiver_of_transmitter, transmitter_of_receiver, {}, {}};
  for (uint32_t receiver = 0; both && receiver < transmitter_of_receiver.size(); ++receiver) {
    if (out.origin_of_receiver[receiver] != no_end) continue;
    out.origin_of_receiver[receiver] = out.count();
    out.listeners.receivers.push_back(receiver);
    out.listeners.close();
  }
  return out;
}

Origins hearing_origins(std::span<const EndState> receivers, uint32_t transmitters, double size_m) {
  Origins out{std::vector<uint32_t>(transmitters, no_end), std::vector<uint32_t>(receivers.size(), no_end), {}, {}};
  ListenerSquares& squares = out.squares.emplace(squares_around(receivers, size_m));
  std::vector<std::vector<uint32_t>> members(size_t{squares.columns} * squares.rows);
  for (uint32_t receiver = 0; receiver < receivers.size(); ++receiver) {
    const glm::dvec3& at = receivers[receiver].position_m;
    const auto x = static_cast<size_t>((at.x - squares.x_m) / squares.size_m);
    const auto y = static_cast<size_t>((at.y - squares.y_m) / squares.size_m);
    members[y * squares.columns + x].push_back(receiver);
  }
  for (const std::vector<uint32_t>& here : members) {
    squares.listeners.push_back(here.empty() ? no_end : out.listeners.count());
    const auto height = [&](uint32_t receiver) { return static_cast<float>(receivers[receiver].position_m.z); };
    const auto [low, high] = std::ranges::minmax_element(here, {}, height);
    squares.heights_m.push_back(here.empty() ? 0 : height(*low));
    squares.heights_m.push_back(here.empty() ? 0 : height(*high));
    if (here.empty()) continue;
    for (const uint32_t receiver : here) out.origin_of_receiver[receiver] = out.count();
    out.listeners.receivers.insert(out.listeners.receivers.end(), here.begin(), here.end());
    out.listeners.close();
  }
  return out;
}

std::vector<bool> standing_origins(const World& world, const Origins& origins) {
  std::vector<bool> out(origins.count(), false);
  std::fill_n(out.begin(), std::min(world.transmitters.standing.size(), out.size()), true);
  for (size_t i = 0; i < std::min(world.receivers.standing.size(), origins.origin_of_receiver.size()); ++i)
    if (const uint32_t origin = origins.origin_of_receiver[i]; origin != no_end) out[origin] = true;
  return out;
}

Launcher launcher_of(uint32_t origin, const EndState& end) {
  return {origin, end.position_m, end.instance == no_instance ? WT_NONE : WT_OWN | end.instance};
}

std::vector<Launcher> sending(const WorldState& world) {
  std::vector<Launcher> out;
  for (const Link& link : world.links)
    if (out.empty() || out.back().transmitter != link.tx)  // links are sorted
      out.push_back(launcher_of(link.tx, world.transmitters[link.tx]));
  return out;
}

std::vector<Launcher> listening(const WorldState& world, const Origins& origins) {
  if (origins.squares) return {};
  std::vector<const EndState*> ends(origins.count(), nullptr);
  for (const Link& link : world.links)
    if (const uint32_t origin = origins.origin_of_receiver[link.rx]; origin != no_end)
      ends[origin] = &world.receivers[link.rx];
  for (const Link& link : world.links) ends[link.tx] = nullptr;
  std::vector<Launcher> out;
  for (uint32_t origin = 0; origin < ends.size(); ++origin)
    if (ends[origin]) out.push_back(launcher_of(origin, *ends[origin]));
  return out;
}

}  // namespace wavetracer
