// SPDX-License-Identifier: Apache-2.0
// LiveSnapshots finds nodes by the points that a simulator asks about. Here these points are the numbers of radios, so
// an antenna that moves while its signal is on the way stays the same.
#include "WavetracerRadios.h"

#include <utility>

#include "WavetracerPhy80211p.h"

namespace wavetracer {
namespace {

const omnetpp::SimTime longest_way(1, omnetpp::SIMTIME_MS);  // of a signal to its receivers: 300 km

LiveVector vector_of(const veins::Coord& v) { return {v.x, v.y, v.z}; }
LiveVector number_of(const WavetracerPhy80211p& radio) { return {static_cast<double>(radio.getId()), 0, 0}; }

}  // namespace

void WavetracerRadios::add(const WavetracerPhy80211p& radio) {
  radios_[radio.getId()] = {&radio, server_.host(radio.host())};
}

void WavetracerRadios::remove(const WavetracerPhy80211p& radio) { radios_.erase(radio.getId()); }

// The position of a vehicle is that of its mobility, on the ground: the antenna of the server has its own height.
void WavetracerRadios::take() {
  const omnetpp::simtime_t now = omnetpp::simTime();
  LiveSnapshot out{now.dbl(), now.dbl(), {}, {}, {}};
  for (const auto& [id, each] : radios_) {
    if (!each.radio->is_placed()) continue;
    veins::BaseMobility& mobility = each.radio->mobility();
    out.nodes.push_back(each.host.node);
    out.points.push_back(number_of(*each.radio));
    out.places.push_back(server_.place(each.host, vector_of(mobility.getPositionAt(now)),
                                       vector_of(mobility.getCurrentSpeed()),
                                       vector_of(mobility.getCurrentOrientation())));
  }
  server_.take(std::move(out));
  server_.forget_before(now - longest_way);
}

double WavetracerRadios::gain(const veins::AntennaPosition& from, const WavetracerPhy80211p& to, double frequency_hz,
                              omnetpp::simtime_t begin) {
  for (const auto& [id, each] : radios_)
    if (each.radio->is_placed() && each.radio->getAntennaPosition().isSameAntenna(from))
      return server_.gain(number_of(*each.radio), number_of(to), frequency_hz, begin.dbl());
  throw omnetpp::cRuntimeError(&to,
                               "wavetracer: a signal comes from a radio that is no WavetracerPhy80211p, or has left: "
                               "all hosts must have the nicType WavetracerNic80211p");
}

}  // namespace wavetracer
