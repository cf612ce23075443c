// SPDX-License-Identifier: Apache-2.0
#ifndef WAVETRACER_INET_PATH_LOSS_H
#define WAVETRACER_INET_PATH_LOSS_H

#include "WavetracerModel.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IPathLoss.h"

namespace wavetracer {

// The gain of a link from ray tracing, as one number for all frequencies: for scalar signals.
class WavetracerPathLoss : public WavetracerModel<inet::physicallayer::IPathLoss> {
 public:
  double computePathLoss(const inet::physicallayer::ITransmission* transmission,
                         const inet::physicallayer::IArrival* arrival) const override;
  // Throws cRuntimeError: a gain from ray tracing is not one of a distance.
  double computePathLoss(inet::units::values::mps propagationSpeed, inet::units::values::Hz frequency,
                         inet::units::values::m distance) const override;
  // NaN, unspecified: reflections may carry further than free space.
  inet::units::values::m computeRange(inet::units::values::mps propagationSpeed, inet::units::values::Hz frequency,
                                      double loss) const override;
};

}  // namespace wavetracer

#endif
