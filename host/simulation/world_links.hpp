// SPDX-License-Identifier: Apache-2.0
// The rules that say which transmitter and receiver belong together: by name, kind, vehicle and distance.
// Assumes that names and carriers of ends never change, only where ends are and whether they are present.
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "simulation/world_ends.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

constexpr uint32_t no_vehicle = std::numeric_limits<uint32_t>::max();

// One side of all links, an entry per end.
struct LinkSide {
  SharedList<RadioEnd> ends;       // only their names count
  std::vector<uint32_t> vehicles;  // the vehicle that carries the end; no_vehicle: it is fixed
};

class LinkRules {
 public:
  // Throws ConfigError for a pattern of names that no end has, RuntimeError for more pairs than a drive can have.
  LinkRules(const LinksConfig& config, LinkSide transmitters, LinkSide receivers);

  // The links of ends that are present, sorted. The two ends of one radio are not linked.
  // Throws RuntimeError where more pairs are present than a frame can have.
  std::vector<Link> operator()(const std::vector<EndState>& transmitters, const std::vector<EndState>& receivers) const;

  // Tells whether any pair is allowed for some places of the ends.
  bool any_allowed() const;

 private:
  // Ends that are present, with their positions in metres.
  struct Places {
    std::vector<uint32_t> ends;
    std::vector<double> x, y, z;
  };
  bool allowed(uint32_t tx_vehicle, uint32_t rx_vehicle) const;
  bool one_radio(uint32_t tx, uint32_t rx) const;
  // Appends the links of a transmitter that is present.
  void add_links(uint32_t tx, const EndState& from, const Places& present, std::vector<Link>& out) const;

  LinksConfig config_;
  LinkSide transmitters_, receivers_;
  std::vector<uint32_t> wanted_transmitters_, wanted_receivers_;  // by name
};

// The rules of [links] for the ends of a world. Throws as LinkRules.
LinkRules link_rules(const LinksConfig& config, const WorldEnds& ends);

}  // namespace wavetracer
