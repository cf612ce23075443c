// SPDX-License-Identifier: Apache-2.0
#include "WavetracerObstacleLoss.h"

#include <cmath>

#include "inet/common/InitStages.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IPropagation.h"
#include "inet/physicallayer/wireless/common/contract/packetlevel/IRadioMedium.h"

namespace wavetracer {

Define_Module(WavetracerObstacleLoss);

void WavetracerObstacleLoss::initialize(int stage) {
  inet::Module::initialize(stage);
  if (stage == inet::INITSTAGE_LOCAL) channel_ = std::make_unique<WavetracerChannel>(this);
}

void WavetracerObstacleLoss::finish() { recordScalar("questions to wavetracer", channel_->questions()); }

std::ostream& WavetracerObstacleLoss::printToStream(std::ostream& stream, int, int) const {
  return stream << "WavetracerObstacleLoss";
}

double WavetracerObstacleLoss::computeObstacleLoss(inet::units::values::Hz frequency, const inet::Coord& from,
                                                   const inet::Coord& to) const {
  const double gain = channel_->gain(from, to, frequency);
  if (std::isnan(frequency.get())) return gain > 0 ? 1 : 0;
  const auto* medium = omnetpp::check_and_cast<const inet::physicallayer::IRadioMedium*>(getParentModule());
  const double wavelength_m = medium->getPropagation()->getPropagationSpeed().get() / frequency.get();
  return gain / free_space_gain(wavelength_m, from.distance(to));
}

}  // namespace wavetracer
