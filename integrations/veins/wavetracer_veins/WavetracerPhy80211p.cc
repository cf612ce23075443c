// SPDX-License-Identifier: Apache-2.0
#include "WavetracerPhy80211p.h"

#include <utility>

#include "WavetracerMedium.h"
#include "veins/base/phyLayer/AnalogueModel.h"
#include "veins/base/toolbox/Signal.h"
#include "veins/base/utils/FindModule.h"

namespace wavetracer {
namespace {

// A model of the receiver. The gain is that of the instant at which the sender began. It may be above that of free
// space, so it does not claim neverIncreasesPower(), and Veins applies it when the signal arrives.
class WavetracerAnalogueModel : public veins::AnalogueModel {
 public:
  WavetracerAnalogueModel(WavetracerPhy80211p* receiver, std::shared_ptr<WavetracerRadios> radios)
      : AnalogueModel(receiver), receiver_(*receiver), radios_(std::move(radios)) {}

  void filterSignal(veins::Signal* signal) override {
    const double frequency_hz = signal->getSpectrum().freqAt(signal->getDataStart());
    *signal *= radios_->gain(signal->getSenderPoa().pos, receiver_, frequency_hz, signal->getSendingStart());
  }

 private:
  const WavetracerPhy80211p& receiver_;
  std::shared_ptr<WavetracerRadios> radios_;
};

}  // namespace

Define_Module(WavetracerPhy80211p);

WavetracerPhy80211p::~WavetracerPhy80211p() {
  if (radios_) radios_->remove(*this);
}

omnetpp::cModule* WavetracerPhy80211p::host() const {
  return veins::FindModule<>::findHost(const_cast<WavetracerPhy80211p*>(this));
}

// The base class makes the analogue models, which need the radios.
void WavetracerPhy80211p::initialize(int stage) {
  if (stage == 0) {
    WavetracerMedium* const medium = veins::FindModule<WavetracerMedium*>::findGlobalModule();
    if (!medium)
      throw omnetpp::cRuntimeError(this,
                                   "wavetracer: the network has no module WavetracerMedium, which names the server");
    radios_ = medium->radios();
  }
  PhyLayer80211p::initialize(stage);
  if (stage == 0) {
    mobility_ = getMobilityModule();
    radios_->add(*this);
  }
}

std::unique_ptr<veins::AnalogueModel> WavetracerPhy80211p::getAnalogueModelFromName(std::string name,
                                                                                    ParameterMap& params) {
  if (name == "WavetracerAnalogueModel") return std::make_unique<WavetracerAnalogueModel>(this, radios_);
  return PhyLayer80211p::getAnalogueModelFromName(name, params);
}

void WavetracerPhy80211p::attachSignal(veins::AirFrame* frame, omnetpp::cObject* control) {
  PhyLayer80211p::attachSignal(frame, control);
  radios_->take();  // the signal begins now
}

}  // namespace wavetracer
