// SPDX-License-Identifier: Apache-2.0
// The ends from which sequences begin: transmitters of wanted links and, if paths are met from both ends, their
// receivers. An end that sends and receives is one origin; receivers that do not send are listeners, origins of their
// own.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "passes/generate_rays.hpp"
#include "passes/listeners.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct World;

// Sides of the squares whose receivers are one listener, and how far above or below them a ray may pass. Smaller ones
// have fewer candidates, larger ones hear more (docs/design/measurements.md).
constexpr double listener_size_m = 20, listener_margin_m = 5;

// Squares of the ground plan with receivers, see passes/listener_map.hpp.
struct ListenerSquares {
  double x_m = 0, y_m = 0, size_m = 1;
  uint32_t columns = 0, rows = 0;
  std::vector<uint32_t> listeners;  // no_end where there is none
  std::vector<float> heights_m;
  float low_m = 0, high_m = 0;
};

// Origins, the roots of sequences: the transmitters by their number, then the listeners.
struct Origins {
  std::vector<uint32_t> receiver_of_transmitter;  // no_end where a transmitter does not receive
  std::vector<uint32_t> origin_of_receiver;       // no_end where a receiver is no origin
  Listeners listeners;
  std::optional<ListenerSquares> squares;  // set where listeners hear the rays of edges, and launch none
  uint32_t transmitter_count() const { return static_cast<uint32_t>(receiver_of_transmitter.size()); }
  uint32_t count() const { return transmitter_count() + listeners.count(); }
};

// both: receivers launch too; otherwise only transmitters do.
Origins make_origins(const std::vector<uint32_t>& receiver_of_transmitter,
                     const std::vector<uint32_t>& transmitter_of_receiver, bool both);

// The same where receivers, which never move, hear the rays of edges: those in a square are one listener. The squares
// have a side of size_m, or more where there would be millions of them.
Origins hearing_origins(std::span<const EndState> receivers, uint32_t transmitters, double size_m);

// For each origin: does it stand, so that it never moves in a drive?
std::vector<bool> standing_origins(const World& world, const Origins& origins);

// The launcher at an end.
Launcher launcher_of(uint32_t origin, const EndState& end);

// The transmitters of wanted links, in their order.
std::vector<Launcher> sending(const WorldState& world);

// The receivers of wanted links that launch and do not send, in the order of their origins.
std::vector<Launcher> listening(const WorldState& world, const Origins& origins);

}  // namespace wavetracer
