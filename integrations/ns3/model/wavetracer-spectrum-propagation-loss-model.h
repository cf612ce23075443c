// SPDX-License-Identifier: Apache-2.0
// The loss of ray-traced channels at each frequency, for channels such as MultiModelSpectrumChannel.
#ifndef WAVETRACER_SPECTRUM_PROPAGATION_LOSS_MODEL_H
#define WAVETRACER_SPECTRUM_PROPAGATION_LOSS_MODEL_H

#include "ns3/spectrum-propagation-loss-model.h"

namespace ns3 {

// The power density in each band is multiplied by |h(f)|^2 at the middle of the band, h(f) = sum a exp(-j 2 pi f tau)
// over the paths of the link. A link without a path has no power. It takes the place of a PropagationLossModel; give
// the channel one of them only.
class WavetracerSpectrumPropagationLossModel : public SpectrumPropagationLossModel {
 public:
  static TypeId GetTypeId();

 private:
  Ptr<SpectrumValue> DoCalcRxPowerSpectralDensity(Ptr<const SpectrumSignalParameters> params,
                                                  Ptr<const MobilityModel> a,
                                                  Ptr<const MobilityModel> b) const override;
  // Nothing is random. ns-3.37 has no such function of the base class, later versions ask for it.
  int64_t DoAssignStreams(int64_t) { return 0; }
};

}  // namespace ns3

#endif
