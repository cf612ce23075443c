// SPDX-License-Identifier: Apache-2.0
// The channels between the radios of a medium of INET, from `wavetracer serve`.
#ifndef WAVETRACER_INET_CHANNEL_H
#define WAVETRACER_INET_CHANNEL_H

#include <omnetpp.h>

#include <map>
#include <set>

#include "inet/common/geometry/common/Coord.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IRadio.h"
#include "wavetracer_server.h"

namespace wavetracer {

// It listens to the medium, which is the parent of the module that owns it: radios come and go, and at the begin of
// each transmission it notes where all of them are. It asks the server when a gain of such an instant is wanted first.
class WavetracerChannel : public omnetpp::cListener {
 public:
  // owner: has the parameters of WavetracerModel. It must be made before radios are added to the medium.
  explicit WavetracerChannel(omnetpp::cModule* owner);
  ~WavetracerChannel() override;

  // The power gain, 0 if there is no path. at: the begin of the transmission; negative: the last instant at which
  // radios were at both positions. NaN as the frequency: it is not compared with that of the server.
  double gain(const inet::Coord& from, const inet::Coord& to, inet::units::values::Hz frequency,
              omnetpp::simtime_t at = -1);
  // The number of questions so far.
  uint64_t questions() const { return server_.questions(); }

  void receiveSignal(omnetpp::cComponent* source, omnetpp::simsignal_t signal, omnetpp::cObject* value,
                     omnetpp::cObject* details) override;

 private:
  struct Radio {
    const inet::physicallayer::IRadio* radio;
    int host;  // the id of its module
  };

  void add(omnetpp::cModule* radio);
  void remove(omnetpp::cModule* radio);
  void take();

  WavetracerServer server_;
  std::map<int, Radio> radios_;                  // by the ids of their modules
  std::map<int, WavetracerServer::Host> hosts_;  // by the ids of their modules
  std::multiset<omnetpp::simtime_t> begins_;     // of the transmissions that the medium has
};

}  // namespace wavetracer

#endif
