// SPDX-License-Identifier: Apache-2.0
#include "WavetracerPathLoss.h"

#include <algorithm>
#include <limits>

#include "inet/physicallayer/wireless/common/contract/packetlevel/INarrowbandSignalAnalogModel.h"

namespace wavetracer {

using inet::units::values::Hz;
using inet::units::values::m;
using inet::units::values::mps;

Define_Module(WavetracerPathLoss);

double WavetracerPathLoss::computePathLoss(const inet::physicallayer::ITransmission* transmission,
                                           const inet::physicallayer::IArrival* arrival) const {
  const auto* signal =
      omnetpp::check_and_cast<const inet::physicallayer::INarrowbandSignalAnalogModel*>(transmission->getAnalogModel());
  return std::min(1.0, channel().gain(transmission->getStartPosition(), arrival->getStartPosition(),
                                      signal->getCenterFrequency(), transmission->getStartTime()));
}

double WavetracerPathLoss::computePathLoss(mps, Hz, m) const {
  throw omnetpp::cRuntimeError(this,
                               "wavetracer: WavetracerPathLoss has no loss for a distance, which dimensional signals "
                               "ask for: use FreeSpacePathLoss and, as obstacleLoss, WavetracerObstacleLoss");
}

m WavetracerPathLoss::computeRange(mps, Hz, double) const { return m(std::numeric_limits<double>::quiet_NaN()); }

}  // namespace wavetracer
