// SPDX-License-Identifier: Apache-2.0
// Prints what the models of integrations/ns3 say of four nodes, one line of JSON per instant, for ns3_test.py: a car
// that is moved by hand, one that drives, a station, and a car outside of the scene.
#include <iostream>
#include <nlohmann/json.hpp>

#include <map>

#include "ns3/config.h"
#include "ns3/constant-position-mobility-model.h"
#include "ns3/constant-velocity-mobility-model.h"
#include "ns3/isotropic-antenna-model.h"
#include "ns3/node.h"
#include "ns3/pointer.h"
#include "ns3/simulator.h"
#include "ns3/spectrum-model.h"
#include "ns3/spectrum-signal-parameters.h"
#include "ns3/string.h"
#include "ns3/three-gpp-spectrum-propagation-loss-model.h"
#include "ns3/uinteger.h"
#include "ns3/uniform-planar-array.h"
#include "ns3/wavetracer-channel.h"
#include "ns3/wavetracer-helper.h"
#include "ns3/wavetracer-matrix-channel-model.h"
#include "ns3/wavetracer-propagation-model.h"
#include "ns3/wavetracer-spectrum-propagation-loss-model.h"

using namespace ns3;

namespace {

std::vector<Ptr<Node>> nodes;

Ptr<MobilityModel> Place(size_t k) { return nodes[k]->GetObject<MobilityModel>(); }

template <class Model>
void AddNode(const Vector& position) {
  const Ptr<Model> mobility = CreateObject<Model>();
  mobility->SetPosition(position);
  nodes.push_back(CreateObject<Node>());
  nodes.back()->AggregateObject(mobility);
}

// A signal of 1 W/Hz at four frequencies.
Ptr<SpectrumSignalParameters> Sent() {
  static const Ptr<SpectrumModel> bands = Create<SpectrumModel>(std::vector<double>{5.895e9, 5.9e9, 5.905e9, 5.915e9});
  const Ptr<SpectrumSignalParameters> sent = Create<SpectrumSignalParameters>();
  sent->psd = Create<SpectrumValue>(bands);
  *sent->psd = 1.0;
  return sent;
}

// The power that arrives of it at each frequency.
std::vector<double> Spectrum(size_t a, size_t b) {
  const Ptr<SpectrumSignalParameters> sent = Sent();
  const auto model = CreateObject<WavetracerSpectrumPropagationLossModel>();
  const Ptr<SpectrumValue> got = model->CalcRxPowerSpectralDensity(sent, Place(a), Place(b));
  return {got->ConstValuesBegin(), got->ConstValuesEnd()};
}

// The same by the antenna path of 3GPP, between arrays of two by two elements, or of one. All elements have the weight
// 1/2.
std::vector<double> MatrixSpectrum(size_t a, size_t b, uint32_t side) {
  static std::map<std::pair<size_t, uint32_t>, Ptr<UniformPlanarArray>> arrays;
  static const auto model = CreateObject<ThreeGppSpectrumPropagationLossModel>();
  static const bool first = [] {
    model->SetChannelModel(CreateObject<WavetracerMatrixChannelModel>());
    return true;
  }();
  const auto array = [&](size_t node) {
    Ptr<UniformPlanarArray>& out = arrays[{node, side}];
    if (out || !first) return out;
    out = CreateObjectWithAttributes<UniformPlanarArray>("NumRows", UintegerValue(side), "NumColumns",
                                                         UintegerValue(side), "AntennaElement",
                                                         PointerValue(CreateObject<IsotropicAntennaModel>()));
    out->SetBeamformingVector(PhasedArrayModel::ComplexVector(side * side, 0.5));
    return out;
  };
  const Ptr<SpectrumSignalParameters> sent = Sent();
  const Ptr<SpectrumValue> got = model->CalcRxPowerSpectralDensity(sent, Place(a), Place(b), array(a), array(b));
  return {got->ConstValuesBegin(), got->ConstValuesEnd()};
}

void Show(const std::string& label) {
  const auto loss = CreateObject<WavetracerPropagationLossModel>();
  const auto delay = CreateObject<WavetracerPropagationDelayModel>();
  nlohmann::json links = nlohmann::json::array();
  for (size_t a = 0; a < nodes.size(); ++a)
    for (size_t b = 0; b < nodes.size(); ++b)
      if (a != b)
        links.push_back({{"from", a},
                         {"to", b},
                         {"gain_db", loss->CalcRxPower(0, Place(a), Place(b))},
                         {"delay_s", delay->GetDelay(Place(a), Place(b)).GetSeconds()},
                         {"los", WavetracerChannel::Get()->IsLineOfSight(Place(a), Place(b))},
                         {"spectrum", Spectrum(a, b)},
                         {"matrix", MatrixSpectrum(a, b, 1)},
                         {"arrays", MatrixSpectrum(a, b, 2)}});
  const Ptr<WavetracerChannel> channel = WavetracerChannel::Get();
  std::cout << nlohmann::json{{"label", label}, {"links", links}, {"frames", channel->GetFrames()}} << std::endl;
}

void Move() {
  Place(0)->SetPosition(Vector(3, -58, 0));
  Show("moved at the same time");
}

void Keep() {
  WavetracerChannel::Get()->SetAttribute("UpdatePeriod", TimeValue(Seconds(0.5)));
  Show("kept");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  Config::SetDefault("ns3::WavetracerChannel::Server", StringValue(argv[1]));
  AddNode<ConstantPositionMobilityModel>(Vector(3, -60, 0));
  AddNode<ConstantVelocityMobilityModel>(Vector(-3, -30, 0));
  nodes[1]->GetObject<ConstantVelocityMobilityModel>()->SetVelocity(Vector(0, -15, 0));
  AddNode<ConstantPositionMobilityModel>(Vector(8, 8, 6));
  AddNode<ConstantPositionMobilityModel>(Vector(5000, 0, 0));
  NodeContainer cars(nodes[0], nodes[1], nodes[3]);
  WavetracerHelper::AddVehicles(cars, "passenger");
  WavetracerHelper::AddStation(nodes[2], "rsu");
  Simulator::Schedule(Seconds(0), &Show, "first");
  Simulator::Schedule(Seconds(0), &Move);
  Simulator::Schedule(Seconds(0.1), &Show, "driven");
  Simulator::Schedule(Seconds(0.1), &Show, "driven, again");
  Simulator::Schedule(Seconds(0.3), &Keep);
  Simulator::Schedule(Seconds(0.7), &Show, "later");
  Simulator::Run();
  Simulator::Destroy();
  return 0;
}
