// SPDX-License-Identifier: Apache-2.0
#include "WavetracerObstacleLoss.h"

#include <cmath>

#include "inet/physicallayer/wireless/common/contract/packetlevel/IPropagation.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IRadioMedium.h"

namespace wavetracer {

Define_Module(WavetracerObstacleLoss);

double WavetracerObstacleLoss::computeObstacleLoss(inet::units::values::Hz frequency, const inet::Coord& from,
                                                   const inet::Coord& to) const {
  const double gain = channel().gain(from, to, frequency);
  if (std::isnan(frequency.get())) return gain > 0 ? 1 : 0;
  const auto* medium = omnetpp::check_and_cast<const inet::physicallayer::IRadioMedium*>(getParentModule());
  const double wavelength_m = medium->getPropagation()->getPropagationSpeed().get() / frequency.get();
  return gain / free_space_gain(wavelength_m, from.distance(to));
}

}  // namespace wavetracer
