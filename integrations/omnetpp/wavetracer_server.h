// SPDX-License-Identifier: Apache-2.0
// `wavetracer serve` as the modules of OMNeT++ see it: the parameters that those of INET and of Veins share, the hosts
// that they name, and the gains of instants. It needs the headers of OMNeT++ and of wavetracer alone.
#ifndef WAVETRACER_OMNETPP_SERVER_H
#define WAVETRACER_OMNETPP_SERVER_H

#include <omnetpp.h>

#include <cmath>
#include <exception>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "wavetracer/live_nodes.hpp"
#include "wavetracer/live_snapshots.hpp"

namespace wavetracer {

// All errors, also those of the server, are cRuntimeError. It connects when it is first asked for something.
class WavetracerServer {
 public:
  struct Host {
    LiveNode node;
    double length_m = 0;
  };

  // owner: has the parameters of WavetracerModel.ned, and must outlive this object.
  explicit WavetracerServer(omnetpp::cComponent* owner)
      : owner_(owner),
        stations_(pairs_of(owner->par("stations").stringValue(), "stations")),
        vehicles_(pairs_of(owner->par("vehicles").stringValue(), "vehicles")) {
    coordinates_.offset_m = {owner->par("offsetX"), owner->par("offsetY"), owner->par("offsetZ")};
    coordinates_.mirror_y = owner->par("mirrorY");
    coordinates_.is_front = owner->par("positionIsFront");
  }

  // The node of the server that a host is, by the patterns of the parameters.
  Host host(const omnetpp::cModule* module) {
    try {
      LiveNodes& server = connected();
      if (const std::string* station = name_for(module->getFullName(), stations_)) return {server.station(*station), 0};
      const std::string* named = name_for(module->getFullName(), vehicles_);
      const std::string type_and_mount = named ? *named : server.first_type();
      const size_t slash = type_and_mount.find('/');
      const std::string type = type_and_mount.substr(0, slash);
      const std::string mount = slash == std::string::npos ? "" : type_and_mount.substr(slash + 1);
      return {server.vehicle("node" + std::to_string(module->getId()), type, mount), server.length_m(type)};
    } catch (const std::exception& error) {
      throw omnetpp::cRuntimeError(owner_, "wavetracer: host %s: %s", module->getFullPath().c_str(), error.what());
    }
  }
  // In the coordinates of the simulation. ahead: the direction in which the host looks.
  LivePlace place(const Host& host, const LiveVector& at, const LiveVector& velocity, const LiveVector& ahead) const {
    return host.node.is_vehicle() ? coordinates_.place(at, velocity, ahead, host.length_m) : LivePlace();
  }

  void take(LiveSnapshot snapshot) {
    connected();
    snapshots_->take(std::move(snapshot));
  }
  void forget_before(omnetpp::simtime_t time) {
    if (snapshots_) snapshots_->forget_before(time.dbl());
  }
  // The power gain between the nodes at these points, 0 if there is no path (see LiveSnapshots::gain_db). NaN as the
  // frequency: it is not compared with that of the server.
  double gain(const LiveVector& from, const LiveVector& to, double frequency_hz, std::optional<double> time_s) {
    const double ours = connected().frequency_hz();
    if (std::abs(frequency_hz - ours) > most_off * ours)
      throw omnetpp::cRuntimeError(owner_,
                                   "wavetracer: a signal has %g Hz, but the server computes channels at %g Hz: set "
                                   "radio.frequency_hz in the configuration of the server",
                                   frequency_hz, ours);
    try {
      return std::pow(10.0, snapshots_->gain_db(from, to, time_s) / 10);
    } catch (const std::exception& error) {
      throw omnetpp::cRuntimeError(owner_, "wavetracer: %s", error.what());
    }
  }
  // The number of questions so far.
  uint64_t questions() const { return server_ ? server_->questions() : 0; }

 private:
  using Pairs = std::vector<std::pair<std::string, std::string>>;  // patterns and names

  static constexpr double most_off = 0.1;  // of the server's frequency: then the gain is off by less than 1 dB

  LiveNodes& connected() {
    if (server_) return *server_;
    LiveClientOptions options;
    options.server = owner_->par("server").stdstringValue();
    options.timeout_s = owner_->par("timeout");
    options.retries = static_cast<unsigned>(owner_->par("retries").intValue());
    const std::string token_file = owner_->par("tokenFile").stdstringValue();
    if (!token_file.empty()) options.token = read_token(token_file);
    try {
      server_ = std::make_unique<LiveNodes>(options);
    } catch (const std::exception& error) {
      throw omnetpp::cRuntimeError(owner_, "wavetracer: %s", error.what());
    }
    snapshots_ = std::make_unique<LiveSnapshots>(*server_, owner_->par("updatePeriod").doubleValue(),
                                                 owner_->par("gain").stdstringValue());
    return *server_;
  }

  // Reads "PATTERN=NAME PATTERN=NAME...".
  Pairs pairs_of(const char* text, const char* parameter) const {
    Pairs out;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      const size_t equals = word.find('=');
      if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
        throw omnetpp::cRuntimeError(owner_, "wavetracer: \"%s\" of the parameter %s is not PATTERN=NAME", word.c_str(),
                                     parameter);
      out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
    return out;
  }
  // The name of the first pattern that the host's name matches, or null.
  static const std::string* name_for(const char* host, const Pairs& patterns) {
    for (const auto& [pattern, name] : patterns)
      if (pattern == host || omnetpp::cPatternMatcher(pattern.c_str(), false, true, true).matches(host)) return &name;
    return nullptr;
  }
  std::string read_token(const std::string& path) const {
    std::ifstream file(path);
    std::string token;
    if (!(file >> token))
      throw omnetpp::cRuntimeError(owner_, "wavetracer: the token file \"%s\" cannot be read, or is empty",
                                   path.c_str());
    return token;
  }

  omnetpp::cComponent* owner_;
  LiveCoordinates coordinates_;
  Pairs stations_, vehicles_;
  std::unique_ptr<LiveNodes> server_;
  std::unique_ptr<LiveSnapshots> snapshots_;
};

}  // namespace wavetracer

#endif
