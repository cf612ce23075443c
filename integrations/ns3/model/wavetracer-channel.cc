// SPDX-License-Identifier: Apache-2.0
#include "wavetracer-channel.h"

#include "ns3/double.h"
#include "ns3/fatal-error.h"
#include "ns3/log.h"
#include "ns3/simulator.h"
#include "ns3/string.h"
#include "ns3/uinteger.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include "wavetracer/live_nodes.hpp"

namespace ns3 {

NS_LOG_COMPONENT_DEFINE("WavetracerChannel");
NS_OBJECT_ENSURE_REGISTERED(WavetracerChannel);

namespace {

Ptr<WavetracerChannel>& OfProcess() {
  static Ptr<WavetracerChannel> channel;
  return channel;
}

void GiveUp() {
  if (OfProcess()) OfProcess()->Dispose();
  OfProcess() = nullptr;
}

bool Same(const Vector& a, const Vector& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

std::string ReadToken(const std::string& path) {
  std::ifstream file(path);
  std::string token;
  if (!(file >> token)) NS_FATAL_ERROR("wavetracer: the token file " << path << " cannot be read, or is empty");
  return token;
}

constexpr double speedOfLight = 299792458.0;

}  // namespace

struct WavetracerChannel::Connection {
  wavetracer::LiveNodes nodes;
};

struct WavetracerChannel::End {
  Ptr<const MobilityModel> mobility;
  double headingDeg = 0;
  bool headingIsSet = false;
  Vector asked;  // the position of the last question
};

// The channels of one instant.
struct WavetracerChannel::Frame {
  Frame(wavetracer::LiveNodeChannels answer, Time when, const std::string& gain)
      : time(when), links(std::move(answer)) {
    const wavetracer::LiveChannels& channels = links.channels;
    ports = channels.answer().at("rx_ports").get<size_t>() * channels.answer().at("tx_ports").get<size_t>();
    firstPath.assign(1, 0);
    for (const uint32_t count : channels.paths) firstPath.push_back(firstPath.back() + count);
    gainDb = channels.link(gain.c_str());
    delayS = channels.path("delay_s");
    a = channels.path("a");
    dopplerHz = channels.path("doppler_hz");
    for (const char* name : {"aod_theta_rad", "aod_phi_rad", "aoa_theta_rad", "aoa_phi_rad"})
      angles.push_back(channels.path(name));
  }
  Time time;
  wavetracer::LiveNodeChannels links;
  size_t ports;
  std::vector<size_t> firstPath;  // per link, and one more
  std::vector<double> gainDb, delayS, dopplerHz, a;
  std::vector<std::vector<double>> angles;
};

TypeId WavetracerChannel::GetTypeId() {
  static TypeId tid =
      TypeId("ns3::WavetracerChannel")
          .SetParent<Object>()
          .SetGroupName("Propagation")
          .AddConstructor<WavetracerChannel>()
          .AddAttribute("Server", "The address of `wavetracer serve`: tcp:ADDRESS:PORT or unix:PATH",
                        StringValue("tcp:127.0.0.1:7710"), MakeStringAccessor(&WavetracerChannel::m_server),
                        MakeStringChecker())
          .AddAttribute("TokenFile", "The file with the server's secret, if it asks for one", StringValue(""),
                        MakeStringAccessor(&WavetracerChannel::m_tokenFile), MakeStringChecker())
          .AddAttribute("Timeout", "The longest wait for an answer, of the wall clock", TimeValue(Seconds(30)),
                        MakeTimeAccessor(&WavetracerChannel::m_timeout), MakeTimeChecker(MilliSeconds(1)))
          .AddAttribute("Retries", "The number of tries to connect again after a connection was lost", UintegerValue(5),
                        MakeUintegerAccessor(&WavetracerChannel::m_retries), MakeUintegerChecker<uint32_t>())
          .AddAttribute(
              "UpdatePeriod",
              "Channels stay for this time although nodes move; 0: a node that moves has new channels at every "
              "instant",
              TimeValue(Seconds(0)), MakeTimeAccessor(&WavetracerChannel::m_updatePeriod), MakeTimeChecker(Seconds(0)))
          .AddAttribute("Gain",
                        "The gain of links: path_gain_db (waves added by their powers), narrowband_gain_db (at the "
                        "carrier) or sum_of_powers_db",
                        StringValue("path_gain_db"), MakeStringAccessor(&WavetracerChannel::m_gain),
                        MakeStringChecker())
          .AddAttribute("NoPathGain", "The gain of a link without a path, dB", DoubleValue(-300.0),
                        MakeDoubleAccessor(&WavetracerChannel::m_noPathGain), MakeDoubleChecker<double>())
          .AddAttribute("Offset", "Metres that are added to the positions of nodes to get those of the scene",
                        VectorValue(Vector(0, 0, 0)), MakeVectorAccessor(&WavetracerChannel::m_offset),
                        MakeVectorChecker());
  return tid;
}

Ptr<WavetracerChannel> WavetracerChannel::Get() {
  if (!OfProcess()) {
    OfProcess() = CreateObject<WavetracerChannel>();
    Simulator::ScheduleDestroy(&GiveUp);
  }
  return OfProcess();
}

WavetracerChannel::WavetracerChannel() = default;
WavetracerChannel::~WavetracerChannel() = default;

void WavetracerChannel::DoDispose() {
  for (const End& end : m_ends)
    ConstCast<MobilityModel>(end.mobility)
        ->TraceDisconnectWithoutContext("CourseChange", MakeCallback(&WavetracerChannel::CourseChanged, this));
  m_ends.clear();
  m_nodes.clear();
  m_endOf.clear();
  m_frame.reset();
  m_connection.reset();
  Object::DoDispose();
}

void WavetracerChannel::Connect() {
  if (m_connection) return;
  wavetracer::LiveClientOptions options;
  options.server = m_server;
  options.detail = "paths";
  options.timeout_s = m_timeout.GetSeconds();
  options.retries = m_retries;
  if (!m_tokenFile.empty()) options.token = ReadToken(m_tokenFile);
  try {
    m_connection.reset(new Connection{wavetracer::LiveNodes(options)});
  } catch (const std::exception& error) {
    NS_FATAL_ERROR("wavetracer: " << error.what());
  }
}

double WavetracerChannel::GetFrequency() {
  Connect();
  return m_connection->nodes.frequency_hz();
}

void WavetracerChannel::Add(Ptr<Node> node, const std::function<wavetracer::LiveNode()>& make) {
  Connect();
  const Ptr<MobilityModel> mobility = node->GetObject<MobilityModel>();
  if (!mobility)
    NS_FATAL_ERROR("wavetracer: node " << node->GetId() << " has no mobility model: install one before it is added");
  if (!m_endOf.emplace(PeekPointer(mobility), m_ends.size()).second)
    NS_FATAL_ERROR("wavetracer: node " << node->GetId() << " was added twice");
  try {
    m_nodes.push_back(make());
  } catch (const std::exception& error) {
    NS_FATAL_ERROR("wavetracer: node " << node->GetId() << ": " << error.what());
  }
  mobility->TraceConnectWithoutContext("CourseChange", MakeCallback(&WavetracerChannel::CourseChanged, this));
  m_ends.emplace_back();
  m_ends.back().mobility = mobility;
  m_frame.reset();
}

void WavetracerChannel::AddVehicle(Ptr<Node> node, const std::string& type, const std::string& mount) {
  Add(node, [&] { return m_connection->nodes.vehicle("node" + std::to_string(node->GetId()), type, mount); });
}

void WavetracerChannel::AddStation(Ptr<Node> node, const std::string& name) {
  Add(node, [&] { return m_connection->nodes.station(name); });
}

void WavetracerChannel::SetHeading(Ptr<Node> node, double degrees) {
  End& end = m_ends[EndOf(node->GetObject<MobilityModel>())];
  m_changed = m_changed || end.headingDeg != degrees;
  if (end.headingDeg != degrees) m_frame.reset();
  end.headingDeg = degrees;
  end.headingIsSet = true;
}

void WavetracerChannel::CourseChanged(Ptr<const MobilityModel>) { m_changed = true; }

size_t WavetracerChannel::EndOf(Ptr<const MobilityModel> mobility) const {
  const auto found = m_endOf.find(PeekPointer(mobility));
  if (found != m_endOf.end()) return found->second;
  NS_FATAL_ERROR("wavetracer: a node at " << mobility->GetPosition()
                                          << " takes part in a channel, but is unknown: add it with "
                                             "WavetracerHelper::AddVehicles or AddStation");
}

bool WavetracerChannel::HasMoved() const {
  for (size_t k = 0; k < m_ends.size(); ++k)
    if (m_nodes[k].is_vehicle() && !Same(m_ends[k].mobility->GetPosition(), m_ends[k].asked)) return true;
  return false;
}

void WavetracerChannel::Update() {
  const Time now = Simulator::Now();
  if (m_frame && !m_changed && now == m_checked) return;
  m_checked = now;
  m_changed = false;
  // A time before that of the frame belongs to another simulation.
  const bool keeps = m_frame && (now >= m_frame->time && now < m_frame->time + m_updatePeriod);
  if (!m_frame || (!keeps && HasMoved())) Ask();
}

wavetracer::LivePlace WavetracerChannel::PlaceOf(End& end) const {
  const Vector at = end.mobility->GetPosition(), speed = end.mobility->GetVelocity();
  const Vector way = speed.GetLength() > 0 ? speed : m_frame ? at - end.asked : Vector();
  if (!end.headingIsSet && std::hypot(way.x, way.y) > 0) end.headingDeg = wavetracer::yaw_of({way.x, way.y, way.z});
  end.asked = at;
  const Vector place = at + m_offset;
  return {{place.x, place.y, place.z}, {speed.x, speed.y, speed.z}, end.headingDeg};
}

void WavetracerChannel::Ask() {
  Connect();
  const auto began = std::chrono::steady_clock::now();
  std::vector<wavetracer::LivePlace> places;
  for (End& end : m_ends) places.push_back(PlaceOf(end));
  const Time now = Simulator::Now();
  try {
    m_frame = std::make_unique<Frame>(m_connection->nodes.channels(now.GetSeconds(), m_nodes, places), now, m_gain);
  } catch (const std::exception& error) {
    NS_FATAL_ERROR("wavetracer: at " << now.GetSeconds() << " s: " << error.what());
  }
  for (const size_t k : m_frame->links.outside)
    NS_LOG_INFO(m_nodes[k].id << " is outside of the scene at " << m_ends[k].asked);
  ++m_frames;
  m_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

int64_t WavetracerChannel::Row(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to) {
  const size_t a = EndOf(from), b = EndOf(to);
  Update();
  return m_frame->links.row(a, b);
}

double WavetracerChannel::GetGainDb(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to) {
  const int64_t row = Row(from, to);
  const auto link = static_cast<size_t>(row);
  if (row < 0 || m_frame->links.channels.paths[link] == 0) return m_noPathGain;
  return std::max(m_frame->gainDb[link], m_noPathGain);
}

Time WavetracerChannel::GetDelay(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to) {
  const int64_t row = Row(from, to);
  const auto link = static_cast<size_t>(row);
  if (row < 0 || m_frame->links.channels.paths[link] == 0) return Seconds(from->GetDistanceFrom(to) / speedOfLight);
  return Seconds(m_frame->delayS[m_frame->firstPath[link]]);  // paths are sorted by delay
}

bool WavetracerChannel::IsLineOfSight(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to) {
  const int64_t row = Row(from, to);
  return row >= 0 && m_frame->links.channels.los[static_cast<size_t>(row)] != 0;
}

std::vector<WavetracerPath> WavetracerChannel::GetPaths(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to) {
  const int64_t row = Row(from, to);
  std::vector<WavetracerPath> out;
  if (row < 0) return out;
  const Frame& frame = *m_frame;
  const auto link = static_cast<size_t>(row);
  for (size_t k = frame.firstPath[link]; k < frame.firstPath[link + 1]; ++k) {
    const size_t first = 2 * frame.ports * k;
    out.push_back({{frame.a[first], frame.a[first + 1]},
                   frame.delayS[k],
                   frame.dopplerHz[k],
                   frame.angles[0][k],
                   frame.angles[1][k],
                   frame.angles[2][k],
                   frame.angles[3][k]});
  }
  return out;
}

}  // namespace ns3
