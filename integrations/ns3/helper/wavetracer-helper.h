// SPDX-License-Identifier: Apache-2.0
// Tells WavetracerChannel which nodes are vehicles and stations of the server's configuration, and makes channels.
#ifndef WAVETRACER_HELPER_H
#define WAVETRACER_HELPER_H

#include "ns3/node-container.h"
#include "ns3/ptr.h"

#include <string>

namespace ns3 {

class MultiModelSpectrumChannel;
class YansWifiChannel;

class WavetracerHelper {
 public:
  // Nodes that have mobility models are vehicles of this type of [[live_vehicle]]; mount: the name of their antenna, or
  // "" for the first one of the type.
  static void AddVehicles(const NodeContainer& nodes, const std::string& type, const std::string& mount = "");
  // The node is a fixed antenna of the configuration.
  static void AddStation(Ptr<Node> node, const std::string& name);

  // Channels with the loss and the delay of ray-traced paths. Only the second one has the loss of each frequency.
  static Ptr<YansWifiChannel> CreateYansChannel();
  static Ptr<MultiModelSpectrumChannel> CreateSpectrumChannel();
};

}  // namespace ns3

#endif
