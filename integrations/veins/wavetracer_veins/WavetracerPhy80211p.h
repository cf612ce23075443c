// SPDX-License-Identifier: Apache-2.0
#ifndef WAVETRACER_VEINS_PHY_H
#define WAVETRACER_VEINS_PHY_H

#include <memory>
#include <string>

#include "WavetracerRadios.h"
#include "veins/modules/phy/PhyLayer80211p.h"

namespace wavetracer {

// The physical layer of Veins with one more analogue model, "WavetracerAnalogueModel": the gain of a link from ray
// tracing, as one number for all frequencies.
class WavetracerPhy80211p : public veins::PhyLayer80211p {
 public:
  ~WavetracerPhy80211p() override;

  omnetpp::cModule* host() const;
  // True once its host has told where it is.
  bool is_placed() const { return isRegistered; }
  veins::BaseMobility& mobility() const { return *mobility_; }

 protected:
  void initialize(int stage) override;
  std::unique_ptr<veins::AnalogueModel> getAnalogueModelFromName(std::string name, ParameterMap& params) override;
  void attachSignal(veins::AirFrame* frame, omnetpp::cObject* control) override;

 private:
  std::shared_ptr<WavetracerRadios> radios_;
  veins::BaseMobility* mobility_ = nullptr;
};

}  // namespace wavetracer

#endif
