// SPDX-License-Identifier: Apache-2.0
// Decides the order in which things are checked, opened and made.
// Clients that connect while the kernels compile wait in the listener's queue.
#include "live/serve.hpp"

#include <fmt/format.h>

#include <csignal>
#include <memory>

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

// Returns where to listen. Throws ConfigError if the protocol does not fit, or if machines could connect that must not.
Endpoint checked_endpoint(const ServeOptions& options) {
  const bool van3twin = options.protocol == Protocol::van3twin;
  const std::string listen = !options.listen.empty() ? options.listen
                             : van3twin              ? "udp:127.0.0.1:8103"
                                                     : "tcp:127.0.0.1:7710";
  Endpoint endpoint = parse_endpoint(listen);
  if (van3twin && !endpoint.datagrams)
    throw ConfigError(fmt::format("--listen {}: clients of VaN3Twin send datagrams: give udp:ADDRESS:PORT", listen));
  if (!van3twin && endpoint.datagrams)
    throw ConfigError(fmt::format(
        "--listen {}: only --protocol van3twin takes datagrams: give unix:PATH or tcp:ADDRESS:PORT", listen));
  if (van3twin && !options.token_file.empty())
    throw ConfigError("--token-file: the protocol of VaN3Twin has no secret: leave it out, and give --peer ADDRESS");
  if (van3twin && !endpoint.loopback && options.van3twin.peer.empty())
    throw ConfigError(
        fmt::format("--listen {}: other machines can send to this address: give --peer ADDRESS, the only one that is "
                    "answered, or listen on udp:127.0.0.1:PORT",
                    listen));
  if (!van3twin && !endpoint.loopback && options.token_file.empty())
    throw ConfigError(
        fmt::format("--listen {}: other machines can connect to this address: give --token-file, "
                    "or listen on unix:PATH or tcp:127.0.0.1:PORT",
                    listen));
  return endpoint;
}

// Makes the simulation, with buffers and kernels, before any client is answered.
std::unique_ptr<Simulation> load(const Config& config, const std::string& device, const Log& log) {
  log("loading the scene and compiling the kernels");
  auto out = std::make_unique<Simulation>(answered(config, log), device);
  out->profile_every(profiled_frames);
  for (const std::string& warning : out->warnings()) log("warning: " + warning);
  out->run_frame(0);
  out->forget();
  return out;
}

}  // namespace

void serve(const Config& config, const ServeOptions& options, const std::function<bool()>& stop, const Log& log,
           const std::function<void(const std::string&)>& ready) {
  if (config.live_vehicles.empty())
    throw ConfigError(
        fmt::format("{}: no [[live_vehicle]]: a server needs to know how many vehicles of which types may come; "
                    "add one with type and count",
                    config.file));
  const Endpoint endpoint = checked_endpoint(options);
  const std::string token = options.token_file.empty() ? "" : read_token(options.token_file);
  std::signal(SIGPIPE, SIG_IGN);
  if (options.protocol == Protocol::van3twin) {
    const DatagramSocket socket(endpoint);
    const std::unique_ptr<Simulation> simulation = load(config, options.device, log);
    van3twin::Server server(*simulation, socket, options.van3twin, log, options.solved);
    ready(socket.name());
    return server.run(stop);
  }
  const Listener listener(endpoint);
  const std::unique_ptr<Simulation> simulation = load(config, options.device, log);
  Server server(*simulation, listener, token, log, options.solved);
  ready(listener.name());
  server.run(stop);
}

}  // namespace wavetracer::live
