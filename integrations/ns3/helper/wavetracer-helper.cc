// SPDX-License-Identifier: Apache-2.0
#include "wavetracer-helper.h"

#include "ns3/multi-model-spectrum-channel.h"
#include "ns3/wavetracer-channel.h"
#include "ns3/wavetracer-propagation-model.h"
#include "ns3/wavetracer-spectrum-propagation-loss-model.h"
#include "ns3/yans-wifi-channel.h"

namespace ns3 {

void WavetracerHelper::AddVehicles(const NodeContainer& nodes, const std::string& type, const std::string& mount) {
  for (auto node = nodes.Begin(); node != nodes.End(); ++node) WavetracerChannel::Get()->AddVehicle(*node, type, mount);
}

void WavetracerHelper::AddStation(Ptr<Node> node, const std::string& name) {
  WavetracerChannel::Get()->AddStation(node, name);
}

Ptr<YansWifiChannel> WavetracerHelper::CreateYansChannel() {
  const Ptr<YansWifiChannel> channel = CreateObject<YansWifiChannel>();
  channel->SetPropagationLossModel(CreateObject<WavetracerPropagationLossModel>());
  channel->SetPropagationDelayModel(CreateObject<WavetracerPropagationDelayModel>());
  return channel;
}

Ptr<MultiModelSpectrumChannel> WavetracerHelper::CreateSpectrumChannel() {
  const Ptr<MultiModelSpectrumChannel> channel = CreateObject<MultiModelSpectrumChannel>();
  channel->AddSpectrumPropagationLossModel(CreateObject<WavetracerSpectrumPropagationLossModel>());
  channel->SetPropagationDelayModel(CreateObject<WavetracerPropagationDelayModel>());
  return channel;
}

}  // namespace ns3
