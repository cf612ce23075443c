// SPDX-License-Identifier: Apache-2.0
#ifndef WAVETRACER_INET_OBSTACLE_LOSS_H
#define WAVETRACER_INET_OBSTACLE_LOSS_H

#include "WavetracerModel.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IObstacleLoss.h"

namespace wavetracer {

// The gain of a link from ray tracing, divided by that of free space. It may be above 1, if reflections help.
class WavetracerObstacleLoss : public WavetracerModel<inet::physicallayer::IObstacleLoss> {
 public:
  // frequency: NaN gives 1 if there is a path, else 0, as signals of unit disks want it.
  double computeObstacleLoss(inet::units::values::Hz frequency, const inet::Coord& transmissionPosition,
                             const inet::Coord& receptionPosition) const override;
};

}  // namespace wavetracer

#endif
