// SPDX-License-Identifier: Apache-2.0
// Runs `wavetracer serve`, without its command line: where to listen, who may connect, then the server until it is told
// to stop. The caller must handle signals.
#pragma once
#include <functional>
#include <string>

#include "live/server.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::live {

struct ServeOptions {
  std::string listen = "tcp:127.0.0.1:7710";  // unix:PATH or tcp:ADDRESS:PORT
  std::string device;                         // in the form of Simulation's argument
  std::string token_file;                     // empty: no token is needed
  FrameSolved solved = {};                    // called with every frame, on the solver's thread
};

// ready: called once, with the name of the endpoint. Everything that needs no device is checked first. Throws
// ConfigError if other machines can connect to the endpoint and there is no token, and the errors of Simulation and
// Server.
void serve(const Config& config, const ServeOptions& options, const std::function<bool()>& stop, const Log& log,
           const std::function<void(const std::string&)>& ready);

}  // namespace wavetracer::live
