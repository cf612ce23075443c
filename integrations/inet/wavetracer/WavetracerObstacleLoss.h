// SPDX-License-Identifier: Apache-2.0
#ifndef WAVETRACER_INET_OBSTACLE_LOSS_H
#define WAVETRACER_INET_OBSTACLE_LOSS_H

#include <memory>
#include <ostream>

#include "WavetracerChannel.h"
#include "inet/common/Module.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IObstacleLoss.h"

namespace wavetracer {

// The gain of a link from ray tracing, divided by that of free space. It may be above 1, if reflections help.
class WavetracerObstacleLoss : public inet::Module, public inet::physicallayer::IObstacleLoss {
 public:
  std::ostream& printToStream(std::ostream& stream, int level, int evFlags = 0) const override;
  // frequency: NaN gives 1 if there is a path, else 0, as signals of unit disks want it.
  double computeObstacleLoss(inet::units::values::Hz frequency, const inet::Coord& transmissionPosition,
                             const inet::Coord& receptionPosition) const override;

 protected:
  void initialize(int stage) override;
  void finish() override;

 private:
  std::unique_ptr<WavetracerChannel> channel_;
};

}  // namespace wavetracer

#endif
