// SPDX-License-Identifier: Apache-2.0
#ifndef WAVETRACER_VEINS_MEDIUM_H
#define WAVETRACER_VEINS_MEDIUM_H

#include <omnetpp.h>

#include <memory>

#include "WavetracerRadios.h"

namespace wavetracer {

// The module of the network that has the parameters of the server. Radios share its WavetracerRadios, which stays as
// long as one of them needs it.
class WavetracerMedium : public omnetpp::cSimpleModule {
 public:
  // Makes it with the first radio, as modules have no order.
  std::shared_ptr<WavetracerRadios> radios() {
    if (!radios_) radios_ = std::make_shared<WavetracerRadios>(this);
    return radios_;
  }

 protected:
  void finish() override { recordScalar("questions to wavetracer", radios()->questions()); }

 private:
  std::shared_ptr<WavetracerRadios> radios_;
};

}  // namespace wavetracer

#endif
