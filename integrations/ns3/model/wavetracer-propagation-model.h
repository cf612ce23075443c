// SPDX-License-Identifier: Apache-2.0
// Loss and delay of ray-traced channels, for channels such as YansWifiChannel; WavetracerChannel has their attributes.
#ifndef WAVETRACER_PROPAGATION_MODEL_H
#define WAVETRACER_PROPAGATION_MODEL_H

#include "ns3/propagation-delay-model.h"
#include "ns3/propagation-loss-model.h"

namespace ns3 {

// The received power is the sent one and the gain of the link. Antennas of the server's configuration are part of that
// gain, so the antennas of ns-3 should be isotropic.
class WavetracerPropagationLossModel : public PropagationLossModel {
 public:
  static TypeId GetTypeId();

 private:
  double DoCalcRxPower(double txPowerDbm, Ptr<MobilityModel> a, Ptr<MobilityModel> b) const override;
  int64_t DoAssignStreams(int64_t stream) override;
};

// The delay is that of the first path.
class WavetracerPropagationDelayModel : public PropagationDelayModel {
 public:
  static TypeId GetTypeId();
  Time GetDelay(Ptr<MobilityModel> a, Ptr<MobilityModel> b) const override;

 private:
  int64_t DoAssignStreams(int64_t stream) override;
};

}  // namespace ns3

#endif
