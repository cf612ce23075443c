// SPDX-License-Identifier: Apache-2.0
// The channels between the radios of a medium of INET, from `wavetracer serve`.
#ifndef WAVETRACER_INET_CHANNEL_H
#define WAVETRACER_INET_CHANNEL_H

#include <omnetpp.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "inet/common/geometry/common/Coord.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IRadio.h"
#include "wavetracer/live_nodes.hpp"
#include "wavetracer/live_snapshots.hpp"

namespace wavetracer {

// It listens to the medium, which is the parent of the module that owns it: radios come and go, and at the begin of
// each transmission it notes where all of them are. It asks the server when a gain of such an instant is wanted first.
// All errors, also those of the server, are cRuntimeError.
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
  uint64_t questions() const { return server_ ? server_->questions() : 0; }

  void receiveSignal(omnetpp::cComponent* source, omnetpp::simsignal_t signal, omnetpp::cObject* value,
                     omnetpp::cObject* details) override;

 private:
  struct Host {
    LiveNode node;
    double length_m = 0;
  };
  struct Radio {
    const inet::physicallayer::IRadio* radio;
    int host;  // the id of its module
  };

  void connect();
  void add(omnetpp::cModule* radio);
  void remove(omnetpp::cModule* radio);
  Host make(omnetpp::cModule* host) const;
  void take();

  omnetpp::cModule *owner_, *medium_;
  LiveCoordinates coordinates_;
  std::vector<std::pair<std::string, std::string>> stations_, vehicles_;  // patterns and names
  std::unique_ptr<LiveNodes> server_;
  std::unique_ptr<LiveSnapshots> snapshots_;
  std::map<int, Radio> radios_;               // by the ids of their modules
  std::map<int, Host> hosts_;                 // by the ids of their modules
  std::multiset<omnetpp::simtime_t> begins_;  // of the transmissions that the medium has
};

}  // namespace wavetracer

#endif
