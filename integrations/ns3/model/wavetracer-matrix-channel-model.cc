// SPDX-License-Identifier: Apache-2.0
// Functions that are called with 0 have two forms, one for ns-3.37 and one for versions whose arrays have ports; the
// first one that compiles is taken.
#include "wavetracer-matrix-channel-model.h"

#include "wavetracer-channel.h"

#include "ns3/boolean.h"
#include "ns3/double.h"
#include "ns3/fatal-error.h"
#include "ns3/node.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace ns3 {

NS_OBJECT_ENSURE_REGISTERED(WavetracerMatrixChannelModel);

namespace {

constexpr size_t mostClusters = 255;  // ThreeGppSpectrumPropagationLossModel of ns-3.37 counts them in a byte

// The number of elements of an array.
template <class Array>
auto ElementsOf(const Array& array, int) -> decltype(size_t{array.GetNumElems()}) {
  return array.GetNumElems();
}
template <class Array>
size_t ElementsOf(const Array& array, long) {
  return array.GetNumberOfElements();
}

// Makes a matrix of zeros; Entry is the one of two elements and a path.
template <class Matrix>
auto ZeroMatrix(Matrix& h, size_t rx, size_t tx, size_t paths, int) -> decltype((void)h(0, 0, 0)) {
  h = Matrix(rx, tx, paths);
}
template <class Matrix>
void ZeroMatrix(Matrix& h, size_t rx, size_t tx, size_t paths, long) {
  h.assign(rx, typename Matrix::value_type(tx, typename Matrix::value_type::value_type(paths)));
}
template <class Matrix>
auto Entry(Matrix& h, size_t rx, size_t tx, size_t path, int) -> decltype((h(rx, tx, path))) {
  return h(rx, tx, path);
}
template <class Matrix>
std::complex<double>& Entry(Matrix& h, size_t rx, size_t tx, size_t path, long) {
  return h[rx][tx][path];
}

// Sines and cosines of the angles, where parameters have them.
template <class Params>
auto FillSincos(Params& params, int) -> decltype((void)params.m_cachedAngleSincos) {
  params.m_cachedAngleSincos.resize(params.m_angle.size());
  for (size_t k = 0; k < params.m_angle.size(); ++k)
    for (const double degrees : params.m_angle[k])
      params.m_cachedAngleSincos[k].emplace_back(std::sin(degrees * M_PI / 180), std::cos(degrees * M_PI / 180));
}
template <class Params>
void FillSincos(Params&, long) {}

// The strongest paths, by their delays. At least one, perhaps without power.
std::vector<WavetracerPath> PathsOf(Ptr<const MobilityModel> a, Ptr<const MobilityModel> b) {
  std::vector<WavetracerPath> paths = WavetracerChannel::Get()->GetPaths(a, b);
  if (paths.size() > mostClusters) {
    std::nth_element(paths.begin(), paths.begin() + mostClusters, paths.end(),
                     [](const auto& one, const auto& other) { return std::norm(one.a) > std::norm(other.a); });
    paths.resize(mostClusters);
    std::sort(paths.begin(), paths.end(), [](const auto& one, const auto& other) { return one.delayS < other.delayS; });
  }
  if (paths.empty()) paths.push_back({});
  return paths;
}

Vector Direction(double theta, double phi) {
  return Vector(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
}
double Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// The vertical pattern of each element in a direction, with the phase of its place, which is in wavelengths.
std::vector<std::complex<double>> Responses(const PhasedArrayModel& array, double theta, double phi) {
  std::vector<std::complex<double>> out;
  const double vertical = array.GetElementFieldPattern(Angles(phi, theta)).second;
  const Vector direction = Direction(theta, phi);
  for (size_t k = 0; k < ElementsOf(array, 0); ++k)
    out.push_back(std::polar(1.0, 2 * M_PI * Dot(direction, array.GetElementLocation(k))) * vertical);
  return out;
}

uint32_t NodeOf(Ptr<const MobilityModel> mobility) { return mobility->GetObject<Node>()->GetId(); }

}  // namespace

TypeId WavetracerMatrixChannelModel::GetTypeId() {
  static TypeId tid =
      TypeId("ns3::WavetracerMatrixChannelModel")
          .SetParent<Object>()
          .SetGroupName("Spectrum")
          .AddConstructor<WavetracerMatrixChannelModel>()
          .AddAttribute("Frequency", "The carrier of the server, Hz", DoubleValue(0.0),
                        MakeDoubleAccessor(&WavetracerMatrixChannelModel::SetFrequency,
                                           &WavetracerMatrixChannelModel::GetFrequency),
                        MakeDoubleChecker<double>(0.0))
          .AddAttribute("Normalized", "Matrices are divided by the gain of the link, which another model has",
                        BooleanValue(true), MakeBooleanAccessor(&WavetracerMatrixChannelModel::m_normalized),
                        MakeBooleanChecker());
  return tid;
}

void WavetracerMatrixChannelModel::SetFrequency(double frequency) {
  if (frequency == 0) return;
  const double served = GetFrequency();
  if (std::abs(frequency - served) > 0.1 * served)
    NS_FATAL_ERROR("wavetracer: the channel is asked for at " << frequency << " Hz, but the server computes at "
                                                              << served
                                                              << " Hz: set radio.frequency_hz of its configuration");
}

double WavetracerMatrixChannelModel::GetFrequency() const { return WavetracerChannel::Get()->GetFrequency(); }

Ptr<const MatrixBasedChannelModel::ChannelMatrix> WavetracerMatrixChannelModel::GetChannel(
    Ptr<const MobilityModel> aMob, Ptr<const MobilityModel> bMob, Ptr<const PhasedArrayModel> aAntenna,
    Ptr<const PhasedArrayModel> bAntenna) {
  const double gainDb = WavetracerChannel::Get()->GetGainDb(aMob, bMob);
  const uint64_t frame = WavetracerChannel::Get()->GetFrames();
  const std::pair<uint32_t, uint32_t> arrays(aAntenna->GetId(), bAntenna->GetId());
  Kept& kept = m_kept[arrays];
  if (kept.matrix && kept.frame == frame) return kept.matrix;

  const std::vector<WavetracerPath> paths = PathsOf(aMob, bMob);
  const double scale = m_normalized ? std::pow(10, -gainDb / 20) : 1;
  const auto matrix = Create<ChannelMatrix>();
  const size_t rx = ElementsOf(*bAntenna, 0), tx = ElementsOf(*aAntenna, 0);
  ZeroMatrix(matrix->m_channel, rx, tx, paths.size(), 0);
  for (size_t n = 0; n < paths.size(); ++n) {
    const auto at = Responses(*bAntenna, paths[n].aoaTheta, paths[n].aoaPhi);
    const auto from = Responses(*aAntenna, paths[n].aodTheta, paths[n].aodPhi);
    for (size_t u = 0; u < rx; ++u)
      for (size_t s = 0; s < tx; ++s) Entry(matrix->m_channel, u, s, n, 0) = scale * paths[n].a * at[u] * from[s];
  }
  // Users of matrices keep what they have computed as long as this time is the same. So it counts frames, of which an
  // instant may have several, and differs for the two directions of a link.
  matrix->m_generatedTime = TimeStep(2 * frame + (arrays.first > arrays.second ? 1 : 0));
  matrix->m_antennaPair = arrays;
  matrix->m_nodeIds = {NodeOf(aMob), NodeOf(bMob)};
  kept = {frame, matrix};
  return matrix;
}

Ptr<const MatrixBasedChannelModel::ChannelParams> WavetracerMatrixChannelModel::GetParams(
    Ptr<const MobilityModel> aMob, Ptr<const MobilityModel> bMob) const {
  const std::vector<WavetracerPath> paths = PathsOf(aMob, bMob);
  const Vector aSpeed = aMob->GetVelocity(), bSpeed = bMob->GetVelocity();
  const auto params = Create<ChannelParams>();
  params->m_generatedTime = TimeStep(WavetracerChannel::Get()->GetFrames());
  params->m_angle.resize(4);
  for (const WavetracerPath& path : paths) {
    params->m_delay.push_back(path.delayS);
    params->m_angle[AOA_INDEX].push_back(path.aoaPhi * 180 / M_PI);
    params->m_angle[ZOA_INDEX].push_back(path.aoaTheta * 180 / M_PI);
    params->m_angle[AOD_INDEX].push_back(path.aodPhi * 180 / M_PI);
    params->m_angle[ZOD_INDEX].push_back(path.aodTheta * 180 / M_PI);
    const double added =
        Dot(Direction(path.aoaTheta, path.aoaPhi), bSpeed) + Dot(Direction(path.aodTheta, path.aodPhi), aSpeed);
    params->m_alpha.push_back(1);
    params->m_D.push_back(-added / 2);
  }
  FillSincos(*params, 0);
  params->m_nodeIds = {NodeOf(aMob), NodeOf(bMob)};
  return params;
}

}  // namespace ns3
