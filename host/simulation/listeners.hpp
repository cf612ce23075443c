// SPDX-License-Identifier: Apache-2.0
// The ends that launch rays: transmitters of wanted links and, if paths are met from both ends, their receivers. An end
// that sends and receives launches once; a receiver that does not send is a listener, an origin of its own.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/generate_rays.hpp"
#include "wavetracer/device/moving.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Origins of rays: the transmitters by their number, then the listeners.
struct Origins {
  std::vector<uint32_t> listeners;           // receivers
  std::vector<uint32_t> receiver_of_origin;  // the receiver that an origin also is, or no_end
  std::vector<uint32_t> origin_of_receiver;  // no_end where a receiver does not launch
  uint32_t count() const { return static_cast<uint32_t>(receiver_of_origin.size()); }
};

// both: receivers launch too; otherwise only transmitters do.
inline Origins make_origins(const std::vector<uint32_t>& receiver_of_transmitter,
                            const std::vector<uint32_t>& transmitter_of_receiver, bool both) {
  Origins out{{}, receiver_of_transmitter, transmitter_of_receiver};
  for (uint32_t receiver = 0; both && receiver < transmitter_of_receiver.size(); ++receiver) {
    if (out.origin_of_receiver[receiver] != no_end) continue;
    out.origin_of_receiver[receiver] = out.count();
    out.receiver_of_origin.push_back(receiver);
    out.listeners.push_back(receiver);
  }
  return out;
}

inline Launcher launcher_of(uint32_t origin, const EndState& end) {
  return {origin, end.position_m, end.instance == no_instance ? WT_NONE : WT_OWN | end.instance};
}

// The transmitters of wanted links, in their order.
inline std::vector<Launcher> sending(const WorldState& world) {
  std::vector<Launcher> out;
  for (const Link& link : world.links)
    if (out.empty() || out.back().transmitter != link.tx)  // links are sorted
      out.push_back(launcher_of(link.tx, world.transmitters[link.tx]));
  return out;
}

// The receivers of wanted links that do not send, in the order of their origins.
inline std::vector<Launcher> listening(const WorldState& world, const Origins& origins) {
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
