// SPDX-License-Identifier: Apache-2.0
// The channels of all nodes of a simulation, from `wavetracer serve`: one question for all pairs of an instant.
#ifndef WAVETRACER_CHANNEL_H
#define WAVETRACER_CHANNEL_H

#include "ns3/mobility-model.h"
#include "ns3/node.h"
#include "ns3/nstime.h"
#include "ns3/object.h"
#include "ns3/vector.h"

#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace wavetracer {
struct LiveNode;
struct LivePlace;
}  // namespace wavetracer

namespace ns3 {

// One path of a link. Angles are those of docs/formats.md: theta from the axis z, phi counter-clockwise from the axis
// x.
struct WavetracerPath {
  std::complex<double> a;  // h(f) = sum of a exp(-j 2 pi f delayS), between the first ports of both antennas
  double delayS;
  double dopplerHz;
  double aodTheta, aodPhi, aoaTheta, aoaPhi;
};

// All models of this module take their channels from one object, Get(). It asks the server when a node has moved and a
// model wants a channel, and keeps the answer as long as no node moves (or as UpdatePeriod says). A node that is
// outside of the scene is left out of the question, and its links have no path. An error of the server ends the
// simulation (NS_FATAL_ERROR) with the server's message.
class WavetracerChannel : public Object {
 public:
  static TypeId GetTypeId();
  // The object of this process, made at the first call from the default values of its attributes, and given up by
  // Simulator::Destroy().
  static Ptr<WavetracerChannel> Get();

  WavetracerChannel();
  ~WavetracerChannel() override;

  // The node is a vehicle of a type of [[live_vehicle]], and its antenna is the mount with this name, or else the first
  // one of the type. The position of its mobility model is the middle of the vehicle on the ground, before Offset.
  void AddVehicle(Ptr<Node> node, const std::string& type, const std::string& mount = "");
  // The node is a fixed end of the configuration; its mobility model is not asked.
  void AddStation(Ptr<Node> node, const std::string& name);
  // The direction that a vehicle looks, counter-clockwise from the axis x. If it is not set, a vehicle looks where it
  // drives, and keeps its direction while it stands.
  void SetHeading(Ptr<Node> node, double degrees);

  // The gain of the link in dB, as the attribute Gain says; NoPathGain if there is no path.
  double GetGainDb(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to);
  // The delay of the first path; if there is none, that of the straight line.
  Time GetDelay(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to);
  bool IsLineOfSight(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to);
  std::vector<WavetracerPath> GetPaths(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to);
  double GetFrequency();  // the carrier of the server, Hz

  uint64_t GetFrames() const { return m_frames; }  // questions so far
  double GetSeconds() const { return m_seconds; }  // time spent in them, of the wall clock

 protected:
  void DoDispose() override;

 private:
  struct End;
  struct Frame;
  struct Connection;

  void Connect();
  void Add(Ptr<Node> node, const std::function<wavetracer::LiveNode()>& make);
  size_t EndOf(Ptr<const MobilityModel> mobility) const;
  // Makes m_frame that of the present positions. Returns its row of the link, or -1.
  int64_t Row(Ptr<const MobilityModel> from, Ptr<const MobilityModel> to);
  void Update();
  bool HasMoved() const;
  wavetracer::LivePlace PlaceOf(End& end) const;
  void Ask();
  void CourseChanged(Ptr<const MobilityModel> mobility);

  std::string m_server, m_tokenFile, m_gain;
  Time m_timeout, m_updatePeriod;
  uint32_t m_retries;
  Vector m_offset;
  double m_noPathGain;

  std::unique_ptr<Connection> m_connection;
  std::vector<End> m_ends;
  std::vector<wavetracer::LiveNode> m_nodes;  // of each end
  std::unordered_map<const MobilityModel*, size_t> m_endOf;
  std::unique_ptr<Frame> m_frame;
  Time m_checked;         // the time of the last comparison of positions
  bool m_changed = true;  // a node has changed its course since then
  uint64_t m_frames = 0;
  double m_seconds = 0;
};

}  // namespace ns3

#endif
