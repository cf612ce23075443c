// SPDX-License-Identifier: Apache-2.0
// Beacons of 802.11p between vehicles that drive past a corner: half of them eastwards, half of them northwards, behind
// the houses of the other street. Positions change every 100 ms, as those that SUMO sends.
//
//     wavetracer serve -c configs/ns3/corner.toml --listen tcp:127.0.0.1:7712
//     wavetracer-corner --server=tcp:127.0.0.1:7712
//
// --receptions names a file for one line per beacon and receiver: step, sender, receiver, sent, gain in dB, delay in
// ns, and 1 if the beacon has arrived.
#include "ns3/command-line.h"
#include "ns3/config.h"
#include "ns3/constant-position-mobility-model.h"
#include "ns3/double.h"
#include "ns3/mobility-helper.h"
#include "ns3/multi-model-spectrum-channel.h"
#include "ns3/packet.h"
#include "ns3/simulator.h"
#include "ns3/spectrum-wifi-helper.h"
#include "ns3/string.h"
#include "ns3/wavetracer-channel.h"
#include "ns3/wavetracer-helper.h"
#include "ns3/wifi-net-device.h"
#include "ns3/yans-wifi-channel.h"
#include "ns3/yans-wifi-helper.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <tuple>

using namespace ns3;

namespace {

constexpr double stepS = 0.1, speed = 14.0;  // seconds, metres per second

// Beacons that were sent, and those that have arrived: (step, sender, receiver).
class Beacons {
 public:
  Beacons(const NodeContainer& nodes, const NetDeviceContainer& devices, uint32_t steps)
      : m_nodes(nodes), m_devices(devices), m_steps(steps) {
    for (uint32_t k = 0; k < devices.GetN(); ++k)
      devices.Get(k)->SetReceiveCallback(MakeCallback(&Beacons::Receive, this));
  }

  // Moves all vehicles, and lets each send once; beacons do not overlap.
  void Step(uint32_t step) {
    for (uint32_t k = 0; k < m_nodes.GetN(); ++k) {
      const double way = -90.0 + 18.0 * (k / 2) + speed * stepS * step;
      m_nodes.Get(k)->GetObject<MobilityModel>()->SetPosition(k % 2 ? Vector(3, way, 0) : Vector(way, -3, 0));
      Simulator::Schedule(MilliSeconds(2) + Seconds(0.09 * k / m_nodes.GetN()), &Beacons::Send, this, step, k);
    }
    if (step + 1 < m_steps) Simulator::Schedule(Seconds(stepS), &Beacons::Step, this, step + 1);
  }

  void Write(std::ostream& out) const {
    char line[160];
    for (const auto& [key, link] : m_links) {
      const auto& [step, from, to] = key;
      std::snprintf(line, sizeof line, "%u %u %u %.17g %.17g %d\n", step, from, to, link.gainDb, link.delayNs,
                    link.arrived);
      out << line;
    }
  }
  size_t Sent() const { return m_links.size(); }
  size_t Arrived() const { return m_arrived; }

 private:
  struct Link {
    double gainDb, delayNs;
    int arrived = 0;
  };

  void Send(uint32_t step, uint32_t from) {
    const uint32_t words[2] = {step, from};
    std::vector<uint8_t> data(200);
    std::memcpy(data.data(), words, sizeof words);
    const Ptr<WavetracerChannel> channel = WavetracerChannel::Get();
    const Ptr<MobilityModel> here = m_nodes.Get(from)->GetObject<MobilityModel>();
    for (uint32_t to = 0; to < m_nodes.GetN(); ++to) {
      if (to == from) continue;
      const Ptr<MobilityModel> there = m_nodes.Get(to)->GetObject<MobilityModel>();
      m_links[{step, from, to}] = {channel->GetGainDb(here, there), 1e9 * channel->GetDelay(here, there).GetSeconds()};
    }
    m_devices.Get(from)->Send(Create<Packet>(data.data(), data.size()), m_devices.Get(from)->GetBroadcast(), 0x88dc);
  }

  bool Receive(Ptr<NetDevice> device, Ptr<const Packet> packet, uint16_t, const Address&) {
    uint32_t words[2];
    packet->CopyData(reinterpret_cast<uint8_t*>(words), sizeof words);
    m_links.at({words[0], words[1], device->GetNode()->GetId()}).arrived += 1;
    ++m_arrived;
    return true;
  }

  NodeContainer m_nodes;
  NetDeviceContainer m_devices;
  uint32_t m_steps;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, Link> m_links;
  size_t m_arrived = 0;
};

NetDeviceContainer InstallRadios(const NodeContainer& nodes, double txPowerDbm, bool spectrum) {
  YansWifiPhyHelper yans;
  yans.SetChannel(WavetracerHelper::CreateYansChannel());
  SpectrumWifiPhyHelper bands;
  bands.SetChannel(WavetracerHelper::CreateSpectrumChannel());
  WifiPhyHelper& phy = spectrum ? static_cast<WifiPhyHelper&>(bands) : static_cast<WifiPhyHelper&>(yans);
  phy.Set("TxPowerStart", DoubleValue(txPowerDbm));
  phy.Set("TxPowerEnd", DoubleValue(txPowerDbm));
  // ns-3.37 sends next to nothing by 802.11p over a spectrum channel, with any loss model: that case has 802.11a.
  phy.Set("ChannelSettings", StringValue(spectrum ? "{36, 20, BAND_5GHZ, 0}" : "{180, 10, BAND_5GHZ, 0}"));
  WifiHelper wifi;
  wifi.SetStandard(spectrum ? WIFI_STANDARD_80211a : WIFI_STANDARD_80211p);
  const StringValue mode(spectrum ? "OfdmRate6Mbps" : "OfdmRate6MbpsBW10MHz");
  wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode", mode, "ControlMode", mode, "NonUnicastMode",
                               mode);
  WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac");
  return wifi.Install(phy, mac, nodes);
}

}  // namespace

int main(int argc, char** argv) {
  std::string server = "tcp:127.0.0.1:7712", receptions;
  uint32_t vehicles = 20;
  double seconds = 10, txPowerDbm = 10;
  bool spectrum = false;
  CommandLine arguments(__FILE__);
  arguments.AddValue("server", "tcp:ADDRESS:PORT or unix:PATH of `wavetracer serve`", server);
  arguments.AddValue("vehicles", "Number of vehicles", vehicles);
  arguments.AddValue("seconds", "Time to simulate", seconds);
  arguments.AddValue("txPower", "Power that each vehicle sends, dBm", txPowerDbm);
  arguments.AddValue("spectrum", "802.11a over channels that depend on frequency", spectrum);
  arguments.AddValue("receptions", "File for one line per beacon and receiver", receptions);
  arguments.Parse(argc, argv);
  Config::SetDefault("ns3::WavetracerChannel::Server", StringValue(server));

  const auto began = std::chrono::steady_clock::now();
  NodeContainer nodes(vehicles);
  MobilityHelper mobility;
  mobility.SetMobilityModel("ns3::ConstantPositionMobilityModel");
  mobility.Install(nodes);
  WavetracerHelper::AddVehicles(nodes, "passenger");
  for (uint32_t k = 0; k < vehicles; ++k) WavetracerChannel::Get()->SetHeading(nodes.Get(k), k % 2 ? 90 : 0);
  const auto steps = static_cast<uint32_t>(seconds / stepS + 0.5);
  Beacons beacons(nodes, InstallRadios(nodes, txPowerDbm, spectrum), steps);
  Simulator::Schedule(Seconds(0), &Beacons::Step, &beacons, 0u);
  Simulator::Stop(Seconds(steps * stepS));
  Simulator::Run();

  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const Ptr<WavetracerChannel> channel = WavetracerChannel::Get();
  std::printf(
      "%zu of %zu beacons have arrived; %llu frames of channels took %.3f s, the rest of the simulation %.3f s\n",
      beacons.Arrived(), beacons.Sent(), static_cast<unsigned long long>(channel->GetFrames()), channel->GetSeconds(),
      all - channel->GetSeconds());
  if (!receptions.empty()) {
    std::ofstream out(receptions);
    beacons.Write(out);
    if (!out.flush()) {
      std::fprintf(stderr, "wavetracer-corner: %s cannot be written\n", receptions.c_str());
      return 1;
    }
  }
  Simulator::Destroy();
  return 0;
}
