// SPDX-License-Identifier: Apache-2.0
// The radios of a simulation of Veins and the gains between them, from `wavetracer serve`.
#ifndef WAVETRACER_VEINS_RADIOS_H
#define WAVETRACER_VEINS_RADIOS_H

#include <omnetpp.h>

#include <map>

#include "veins/base/utils/AntennaPosition.h"
#include "wavetracer_server.h"

namespace wavetracer {

class WavetracerPhy80211p;

// Where all radios are is noted at the begin of each transmission. The server is asked when a gain of such an instant
// is wanted first, for all pairs at once.
class WavetracerRadios {
 public:
  // owner: has the parameters of WavetracerMedium.
  explicit WavetracerRadios(omnetpp::cComponent* owner) : server_(owner) {}

  void add(const WavetracerPhy80211p& radio);
  void remove(const WavetracerPhy80211p& radio);
  // Notes where all radios are now.
  void take();
  // The power gain from the radio whose antenna is `from` to another one, of the transmission that began at this time.
  double gain(const veins::AntennaPosition& from, const WavetracerPhy80211p& to, double frequency_hz,
              omnetpp::simtime_t begin);
  // The number of questions so far.
  uint64_t questions() const { return server_.questions(); }

 private:
  struct Radio {
    const WavetracerPhy80211p* radio;
    WavetracerServer::Host host;
  };

  WavetracerServer server_;
  std::map<int, Radio> radios_;  // by the ids of their modules, so that every run has one order
};

}  // namespace wavetracer

#endif
