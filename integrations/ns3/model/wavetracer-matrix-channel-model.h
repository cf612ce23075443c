// SPDX-License-Identifier: Apache-2.0
// Channel matrices between the elements of two antenna arrays of ns-3, from ray-traced paths: each path is a cluster.
#ifndef WAVETRACER_MATRIX_CHANNEL_MODEL_H
#define WAVETRACER_MATRIX_CHANNEL_MODEL_H

#include "ns3/matrix-based-channel-model.h"

#include <map>
#include <utility>

namespace ns3 {

// Takes the place of ThreeGppChannelModel in a ThreeGppSpectrumPropagationLossModel, for 5G-LENA and mmwave. H[u][s][n]
// is the coefficient of path n, times the vertical field patterns of both elements in its directions, and the phases of
// their places in the arrays. The server's antennas must be isotropic with vertical polarization, as those of ns-3 are
// the ones that count. Frequency is the server's carrier.
//
// Normalized (true): matrices are divided by the gain of the link, as those of 3GPP are, and a
// WavetracerPropagationLossModel has that gain. If it is false, give the channel no other loss.
//
// Doppler shifts: channels are those of the present places, so that their phases turn as nodes move. The turn that
// ThreeGppSpectrumPropagationLossModel adds by the velocities of nodes is taken back by the terms alpha and D, or each
// shift would count twice.
class WavetracerMatrixChannelModel : public MatrixBasedChannelModel {
 public:
  static TypeId GetTypeId();

  Ptr<const ChannelMatrix> GetChannel(Ptr<const MobilityModel> aMob, Ptr<const MobilityModel> bMob,
                                      Ptr<const PhasedArrayModel> aAntenna,
                                      Ptr<const PhasedArrayModel> bAntenna) override;
  Ptr<const ChannelParams> GetParams(Ptr<const MobilityModel> aMob, Ptr<const MobilityModel> bMob) const override;

  // A frequency that differs from the server's carrier by more than a tenth ends the simulation; 0 changes nothing.
  void SetFrequency(double frequency);
  double GetFrequency() const;

 private:
  struct Kept {
    uint64_t frame = 0;
    Ptr<const ChannelMatrix> matrix;
  };
  bool m_normalized = true;
  std::map<std::pair<uint32_t, uint32_t>, Kept> m_kept;  // by the ids of both arrays
};

}  // namespace ns3

#endif
