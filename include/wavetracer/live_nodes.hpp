// SPDX-License-Identifier: Apache-2.0
// The nodes of a network simulator and the channels between them, by live_client.hpp. It has no type of a simulator:
// the modules of integrations/ are made of it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "wavetracer/live_client.hpp"

namespace wavetracer {

using LiveVector = std::array<double, 3>;

// A node of a simulator: a vehicle, or a fixed end of the server, which has neither id nor type.
struct LiveNode {
  std::string id, type;
  std::string antenna;  // its name in the answers

  bool is_vehicle() const { return !type.empty(); }
  bool operator==(const LiveNode& other) const {
    return id == other.id && type == other.type && antenna == other.antenna;
  }
};

// The pose of a vehicle, in the coordinates of the scene: the middle of its footprint, on the ground.
struct LivePlace {
  LiveVector position_m{};
  LiveVector velocity_m_s{};  // 0: the server takes it from the last two poses
  double yaw_deg = 0;         // counter-clockwise from the axis x

  bool moves() const { return velocity_m_s != LiveVector{}; }
  bool operator==(const LivePlace& other) const {
    return position_m == other.position_m && velocity_m_s == other.velocity_m_s && yaw_deg == other.yaw_deg;
  }
};

// The channels between nodes at an instant.
class LiveNodeChannels {
 public:
  LiveNodeChannels(LiveChannels answer, const std::vector<LiveNode>& nodes)
      : channels(std::move(answer)), nodes_(nodes.size()), rows_(nodes.size() * nodes.size(), -1) {
    const std::vector<int64_t> tx = places_of(channels.transmitters, nodes), rx = places_of(channels.receivers, nodes);
    for (size_t row = 0; row < channels.size(); ++row) {
      const int64_t from = tx[channels.tx[row]], to = rx[channels.rx[row]];
      if (from >= 0 && to >= 0)
        rows_[static_cast<size_t>(from) * nodes_ + static_cast<size_t>(to)] = static_cast<int64_t>(row);
    }
  }

  LiveChannels channels;
  std::vector<size_t> outside;  // the vehicles that are outside of the scene: their links are not there

  // The link from one node to another one, by their places in the list of nodes; -1 if there is none.
  int64_t row(size_t from, size_t to) const { return rows_[from * nodes_ + to]; }
  // The same, but also -1 if no path arrives.
  int64_t row_with_paths(size_t from, size_t to) const {
    const int64_t found = row(from, to);
    return found >= 0 && channels.paths[static_cast<size_t>(found)] > 0 ? found : -1;
  }

 private:
  static std::vector<int64_t> places_of(const std::vector<std::string>& names, const std::vector<LiveNode>& nodes) {
    std::unordered_map<std::string, int64_t> place;
    for (size_t k = 0; k < nodes.size(); ++k) place[nodes[k].antenna] = static_cast<int64_t>(k);
    std::vector<int64_t> out;
    for (const std::string& name : names) {
      const auto found = place.find(name);
      out.push_back(found == place.end() ? -1 : found->second);
    }
    return out;
  }

  size_t nodes_;
  std::vector<int64_t> rows_;  // per pair of nodes
};

// The server as simulators see it. Constructor and channels() throw what LiveClient throws.
class LiveNodes {
 public:
  explicit LiveNodes(const LiveClientOptions& options) : client_(options) {}

  double frequency_hz() const { return client_.world().at("frequency_hz").get<double>(); }
  // The number of questions so far.
  uint64_t questions() const { return questions_; }
  // The type of the first [[live_vehicle]].
  std::string first_type() const { return client_.world().at("types").at(0).at("type").get<std::string>(); }
  double length_m(const std::string& type) const { return type_of(type).at("length_m").get<double>(); }

  // A vehicle of a type of [[live_vehicle]]; its antenna is the mount with this name, or the first one of the type if
  // the name is empty. Throws std::invalid_argument if the server has none of these.
  LiveNode vehicle(const std::string& id, const std::string& type, const std::string& mount) const {
    for (const auto& each : type_of(type).at("mounts"))
      if (mount.empty() || each.at("name") == mount) return {id, type, id + '/' + each.at("name").get<std::string>()};
    throw std::invalid_argument("vehicles of type \"" + type + "\" have no antenna \"" + mount +
                                "\": add a [[mount]] to the configuration of the server");
  }
  // A fixed end of the configuration. Throws std::invalid_argument if the server has none of this name.
  LiveNode station(const std::string& name) const {
    for (const char* list : {"transmitters", "receivers"})
      for (const auto& each : client_.world().at(list))
        if (each == name) return {"", "", name};
    throw std::invalid_argument("the configuration of the server has no fixed antenna \"" + name +
                                "\": add a [[station]], [[transmitter]] or [[receiver]]");
  }

  // One question for all pairs. places: one for each node; those of stations are not used.
  LiveNodeChannels channels(double time_s, const std::vector<LiveNode>& nodes, const std::vector<LivePlace>& places) {
    std::vector<size_t> outside;
    nlohmann::json vehicles = nlohmann::json::array();
    for (size_t k = 0; k < nodes.size(); ++k) {
      if (!nodes[k].is_vehicle()) continue;
      if (is_inside(places[k].position_m))
        vehicles.push_back(pose(nodes[k], places[k]));
      else
        outside.push_back(k);
    }
    LiveNodeChannels out(client_.channels(time_s, std::move(vehicles)), nodes);
    out.outside = std::move(outside);
    ++questions_;
    return out;
  }

 private:
  const nlohmann::json& type_of(const std::string& type) const {
    for (const auto& each : client_.world().at("types"))
      if (each.at("type") == type) return each;
    throw std::invalid_argument("the configuration of the server has no [[live_vehicle]] of type \"" + type +
                                "\": add one, or name another type");
  }
  bool is_inside(const LiveVector& position_m) const {
    const nlohmann::json& bounds = client_.world().at("bounds_m");
    for (size_t k = 0; k < 3; ++k)
      if (!(position_m[k] >= bounds.at("lower")[k].get<double>() &&
            position_m[k] <= bounds.at("upper")[k].get<double>()))
        return false;
    return true;
  }
  static nlohmann::json pose(const LiveNode& node, const LivePlace& place) {
    nlohmann::json out = {
        {"id", node.id}, {"type", node.type}, {"position_m", place.position_m}, {"yaw_deg", place.yaw_deg}};
    if (place.moves()) out["velocity_m_s"] = place.velocity_m_s;
    return out;
  }

  LiveClient client_;
  uint64_t questions_ = 0;
};

// The direction of a vector in the plane, degrees counter-clockwise from the axis x.
inline double yaw_of(const LiveVector& way) { return std::atan2(way[1], way[0]) * 180 / 3.14159265358979323846; }

}  // namespace wavetracer
