// `wavetracer serve`, without its command line: where to listen, whom to trust, then the server until it is told to
// stop. Assumes that the caller has seen to signals.
#pragma once
#include <functional>
#include <string>

#include "live/server.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::live {

struct ServeOptions {
  std::string listen = "tcp:127.0.0.1:7710";  // unix:PATH or tcp:ADDRESS:PORT
  std::string device;                         // as for Simulation
  std::string token_file;                     // empty: no token
  FrameSolved solved = {};                    // called with every frame, on the thread that solves
};

// ready: called once, with the name of the endpoint. Everything that needs no device is checked first. Throws
// ConfigError for an endpoint beyond this machine without a token, and whatever Simulation and Server throw.
void serve(const Config& config, const ServeOptions& options, const std::function<bool()>& stop, const Log& log,
           const std::function<void(const std::string&)>& ready);

}  // namespace wavetracer::live
