// SPDX-License-Identifier: Apache-2.0
#include "wavetracer-spectrum-propagation-loss-model.h"

#include "wavetracer-channel.h"

#include "ns3/spectrum-signal-parameters.h"

#include <cmath>
#include <complex>

namespace ns3 {

NS_OBJECT_ENSURE_REGISTERED(WavetracerSpectrumPropagationLossModel);

TypeId WavetracerSpectrumPropagationLossModel::GetTypeId() {
  static TypeId tid = TypeId("ns3::WavetracerSpectrumPropagationLossModel")
                          .SetParent<SpectrumPropagationLossModel>()
                          .SetGroupName("Spectrum")
                          .AddConstructor<WavetracerSpectrumPropagationLossModel>();
  return tid;
}

Ptr<SpectrumValue> WavetracerSpectrumPropagationLossModel::DoCalcRxPowerSpectralDensity(
    Ptr<const SpectrumSignalParameters> params, Ptr<const MobilityModel> a, Ptr<const MobilityModel> b) const {
  const std::vector<WavetracerPath> paths = WavetracerChannel::Get()->GetPaths(a, b);
  Ptr<SpectrumValue> out = params->psd->Copy();
  auto band = out->ConstBandsBegin();
  for (auto value = out->ValuesBegin(); value != out->ValuesEnd(); ++value, ++band) {
    std::complex<double> h = 0;
    for (const WavetracerPath& path : paths)
      h += path.a * std::polar(1.0, -2 * M_PI * std::fmod(band->fc * path.delayS, 1.0));
    *value *= std::norm(h);
  }
  return out;
}

}  // namespace ns3
