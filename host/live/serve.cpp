// SPDX-License-Identifier: Apache-2.0
// Decides the order in which things are checked, opened and made.
// Clients that connect while the kernels compile wait in the listener's queue.
#include "live/serve.hpp"

#include <fmt/format.h>

#include <csignal>

#include "live/token.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::live {

namespace {

// Removes the parts that answers cannot contain, which would be computed in vain.
Config answered(Config config, const Log& log) {
  const auto drop = [&log](const char* key, const char* file) {
    log(fmt::format("warning: {} is left out: answers have paths and links, but not the contents of {}", key, file));
  };
  if (config.response.bandwidth_hz) drop("response.bandwidth_hz", "responses.h5");
  config.response.bandwidth_hz.reset();
  for (ArrayConfig& array : config.arrays) {
    if (array.has_codebook()) drop("array.codebook", "beams.h5");
    array.codebook = "none";
  }
  if (config.radio.frequencies_hz.size() > 1) drop("radio.frequencies_hz but its first", "carriers.h5");
  config.radio.frequencies_hz.clear();
  return config;
}

}  // namespace

void serve(const Config& config, const ServeOptions& options, const std::function<bool()>& stop, const Log& log,
           const std::function<void(const std::string&)>& ready) {
  if (config.live_vehicles.empty())
    throw ConfigError(
        fmt::format("{}: no [[live_vehicle]]: a server needs to know how many vehicles of which types may come; "
                    "add one with type and count",
                    config.file));
  const Endpoint endpoint = parse_endpoint(options.listen);
  const std::string token = options.token_file.empty() ? "" : read_token(options.token_file);
  if (token.empty() && !endpoint.loopback)
    throw ConfigError(
        fmt::format("--listen {}: other machines can connect to this address: give --token-file, "
                    "or listen on unix:PATH or tcp:127.0.0.1:PORT",
                    options.listen));
  std::signal(SIGPIPE, SIG_IGN);
  const Listener listener(endpoint);
  log("loading the scene and compiling the kernels");
  Simulation simulation(answered(config, log), options.device);
  simulation.profile_every(profiled_frames);
  for (const std::string& warning : simulation.warnings()) log("warning: " + warning);
  simulation.run_frame(0);  // before any client connects: buffers are made, drivers finish compiling
  simulation.forget();
  Server server(simulation, listener, token, log, options.solved);
  ready(listener.name());
  server.run(stop);
}

}  // namespace wavetracer::live
