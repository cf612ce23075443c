// SPDX-License-Identifier: Apache-2.0
// `wavetracer serve --protocol van3twin`: answers the datagrams of VaN3Twin's ns-3 modules, one by one on one thread. A
// question after a vehicle has moved computes the channels of all vehicles; others are answered from that frame. If all
// vehicles have been updated and no datagram comes for a millisecond, the frame is computed before it is asked for.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>

#include "live/datagram_socket.hpp"
#include "live/limited_log.hpp"
#include "live/server.hpp"
#include "live/van3twin_message.hpp"
#include "live/van3twin_traffic.hpp"

namespace wavetracer::live::van3twin {

struct Options {
  Coordinates coordinates;
  bool narrowband = true;  // the gain is that of the sum of fields at the carrier; else waves are added by their powers
  std::string peer;        // the only address that is answered; empty: each
};

class Server {
 public:
  // The simulation must have [[live_vehicle]], and must not be used by other code meanwhile.
  Server(Simulation& simulation, const DatagramSocket& socket, const Options& options, Log log,
         FrameSolved solved = {});
  // Runs until stop() returns true; it is called ten times per second. Throws DeviceError if the device fails.
  void run(const std::function<bool()>& stop);

 private:
  // A client: the address that datagrams come from.
  struct Source {
    std::string name;
    Traffic traffic;
    LiveTraffic live = {};
    std::unordered_map<std::string, Link> links = {};  // by the names of both antennas
    Clock::time_point spoke = {};
    bool told = false;   // the log says already that a vehicle of it is absent
    bool asked = false;  // its last frame was asked about
  };

  // Returns the answer, or "" if there is none.
  std::string handle(const Datagram& datagram);
  std::string locate(const Datagram& datagram, const LocationUpdate& update);
  std::string tell(const Datagram& datagram, const Question& question);
  Source* find(const SocketAddress& address);
  // Returns null if no more clients can be kept: one is replaced only after it was silent for ten seconds.
  Source* admit(const SocketAddress& address);
  void solve(Source& source);
  // The first client whose frame will probably be asked for, or null: one that asked about its last frame, and has
  // updated every vehicle since then.
  Source* due() const;
  void forget(const SocketAddress& address);

  Simulation& simulation_;
  const DatagramSocket& socket_;
  Options options_;
  Log log_;
  LimitedLog of_clients_;  // lines that any datagram may cause
  FrameSolved solved_;
  std::map<SocketAddress, std::unique_ptr<Source>> sources_;
  const Clock::time_point began_ = Clock::now();
  uint64_t not_understood_ = 0, turned_away_ = 0, frames_ = 0, frames_ahead_ = 0;
};

}  // namespace wavetracer::live::van3twin
