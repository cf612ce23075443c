// SPDX-License-Identifier: Apache-2.0
// Runs `wavetracer serve`, without its command line: where to listen, who may connect, then the server until it is told
// to stop. The caller must handle signals.
#pragma once
#include <functional>
#include <string>

#include "live/server.hpp"
#include "live/van3twin_server.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::live {

enum class Protocol { live, van3twin };

struct ServeOptions {
  Protocol protocol = Protocol::live;
  std::string listen;          // empty: tcp:127.0.0.1:7710, or udp:127.0.0.1:8103 for VaN3Twin
  std::string device;          // in the form of Simulation's argument
  std::string token_file;      // empty: no token is needed
  FrameSolved solved = {};     // called with every frame, on the solver's thread
  van3twin::Options van3twin;  // for this protocol only
};

// ready: called once, with the name of the endpoint. Everything that needs no device is checked first. Throws
// ConfigError if other machines can connect to the endpoint and there is no token, and the errors of Simulation and
// Server.
void serve(const Config& config, const ServeOptions& options, const std::function<bool()>& stop, const Log& log,
           const std::function<void(const std::string&)>& ready);

}  // namespace wavetracer::live
