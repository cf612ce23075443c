// SPDX-License-Identifier: Apache-2.0
#include "WavetracerChannel.h"

#include <optional>
#include <utility>

#include "inet/common/ModuleAccess.h"
#include "inet/common/geometry/common/Quaternion.h"
#include "inet/mobility/contract/IMobility.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IAntenna.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IRadioMedium.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/ITransmission.h"

namespace wavetracer {

using inet::Coord;
using inet::physicallayer::IRadio;
using inet::physicallayer::IRadioMedium;
using inet::physicallayer::ITransmission;
using omnetpp::cModule;
using omnetpp::cRuntimeError;

namespace {

LiveVector vector_of(const Coord& v) { return {v.x, v.y, v.z}; }

}  // namespace

WavetracerChannel::WavetracerChannel(cModule* owner) : server_(owner) {
  cModule* const medium = owner->getParentModule();
  if (!dynamic_cast<IRadioMedium*>(medium))
    throw cRuntimeError(owner, "wavetracer: this module must be a submodule of a radio medium, such as its pathLoss");
  for (const auto signal : {IRadioMedium::radioAddedSignal, IRadioMedium::radioRemovedSignal,
                            IRadioMedium::signalAddedSignal, IRadioMedium::signalRemovedSignal})
    medium->subscribe(signal, this);
}

// The medium may be gone already: cListener unsubscribes itself.
WavetracerChannel::~WavetracerChannel() = default;

void WavetracerChannel::receiveSignal(omnetpp::cComponent*, omnetpp::simsignal_t signal, omnetpp::cObject* value,
                                      omnetpp::cObject*) {
  if (signal == IRadioMedium::radioAddedSignal) {
    add(omnetpp::check_and_cast<cModule*>(value));
  } else if (signal == IRadioMedium::radioRemovedSignal) {
    remove(omnetpp::check_and_cast<cModule*>(value));
  } else if (signal == IRadioMedium::signalAddedSignal) {
    begins_.insert(dynamic_cast<const ITransmission&>(*value).getStartTime());
    take();
  } else if (signal == IRadioMedium::signalRemovedSignal) {
    const auto found = begins_.find(dynamic_cast<const ITransmission&>(*value).getStartTime());
    if (found != begins_.end()) begins_.erase(found);
    server_.forget_before(begins_.empty() ? omnetpp::simTime() : *begins_.begin());
  }
}

void WavetracerChannel::add(cModule* radio) {
  cModule* const host = inet::getContainingNode(radio);
  radios_[radio->getId()] = {omnetpp::check_and_cast<const IRadio*>(radio), host->getId()};
  if (hosts_.count(host->getId()) == 0) hosts_[host->getId()] = server_.host(host);
  if (!begins_.empty()) take();  // signals in the air arrive at it, too
}

void WavetracerChannel::remove(cModule* radio) {
  const auto found = radios_.find(radio->getId());
  if (found == radios_.end()) return;
  const int host = found->second.host;
  radios_.erase(found);
  for (const auto& [id, each] : radios_)
    if (each.host == host) return;
  hosts_.erase(host);
}

// A host with several radios is one vehicle, at the position of its first radio's antenna.
void WavetracerChannel::take() {
  const double now_s = omnetpp::simTime().dbl();
  LiveSnapshot out{now_s, now_s, {}, {}, {}};
  std::set<int> seen;
  for (const auto& [id, each] : radios_) {
    if (!seen.insert(each.host).second) continue;
    const WavetracerServer::Host& host = hosts_.at(each.host);
    inet::IMobility* const mobility = each.radio->getAntenna()->getMobility();
    const Coord at = mobility->getCurrentPosition();
    out.nodes.push_back(host.node);
    out.points.push_back(vector_of(at));
    out.places.push_back(server_.place(host, vector_of(at), vector_of(mobility->getCurrentVelocity()),
                                       vector_of(mobility->getCurrentAngularPosition().rotate(Coord::X_AXIS))));
  }
  server_.take(std::move(out));
}

double WavetracerChannel::gain(const Coord& from, const Coord& to, inet::units::values::Hz frequency,
                               omnetpp::simtime_t at) {
  const auto time_s = at < 0 ? std::nullopt : std::optional<double>(at.dbl());
  return server_.gain(vector_of(from), vector_of(to), frequency.get(), time_s);
}

}  // namespace wavetracer
