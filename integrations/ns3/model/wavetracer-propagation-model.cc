// SPDX-License-Identifier: Apache-2.0
#include "wavetracer-propagation-model.h"

#include "wavetracer-channel.h"

namespace ns3 {

NS_OBJECT_ENSURE_REGISTERED(WavetracerPropagationLossModel);
NS_OBJECT_ENSURE_REGISTERED(WavetracerPropagationDelayModel);

TypeId WavetracerPropagationLossModel::GetTypeId() {
  static TypeId tid = TypeId("ns3::WavetracerPropagationLossModel")
                          .SetParent<PropagationLossModel>()
                          .SetGroupName("Propagation")
                          .AddConstructor<WavetracerPropagationLossModel>();
  return tid;
}

double WavetracerPropagationLossModel::DoCalcRxPower(double txPowerDbm, Ptr<MobilityModel> a,
                                                     Ptr<MobilityModel> b) const {
  return txPowerDbm + WavetracerChannel::Get()->GetGainDb(a, b);
}

int64_t WavetracerPropagationLossModel::DoAssignStreams(int64_t) { return 0; }

TypeId WavetracerPropagationDelayModel::GetTypeId() {
  static TypeId tid = TypeId("ns3::WavetracerPropagationDelayModel")
                          .SetParent<PropagationDelayModel>()
                          .SetGroupName("Propagation")
                          .AddConstructor<WavetracerPropagationDelayModel>();
  return tid;
}

Time WavetracerPropagationDelayModel::GetDelay(Ptr<MobilityModel> a, Ptr<MobilityModel> b) const {
  return WavetracerChannel::Get()->GetDelay(a, b);
}

int64_t WavetracerPropagationDelayModel::DoAssignStreams(int64_t) { return 0; }

}  // namespace ns3
