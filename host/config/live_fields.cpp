// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about live coupling: the vehicles that clients of `wavetracer serve` may bring, and limits.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table live_table() {
  const auto l = [](auto member) { return at(&Config::live, member); };
  return {
      .name = "live",
      .doc =
          "Limits on what `wavetracer serve` accepts from its clients. "
          "A client that exceeds one gets an error message or is disconnected.",
      .fields = {
          {.name = "margin_m",
           .slot = l(&LiveConfig::margin_m),
           .unit = "m",
           .range = {0, 1e5},
           .doc =
               "The largest distance of vehicles from the bounding box of the scene, in x, y and z. Farther outside, "
               "float32 arithmetic would make ray tracing less accurate for all clients."},
          {.name = "max_clients",
           .slot = l(&LiveConfig::max_clients),
           .range = {1, 1000},
           .doc = "The largest number of clients that have said hello and are connected at the same time. "
                  "They use the device in turn, frame by frame."},
          {.name = "max_strangers",
           .slot = l(&LiveConfig::max_strangers),
           .range = {1, 1000},
           .doc = "The largest number of connections that have not said hello yet. When one more arrives, the one "
                  "that has waited longest is closed, so that silent connections cannot keep clients out."},
          {.name = "max_message_bytes",
           .slot = l(&LiveConfig::max_message_bytes),
           .unit = "bytes per line",
           .range = {1024, 1073741824.0},
           .doc = "The largest length of a message to the server. A pose takes 100 to 250 bytes."},
          {.name = "max_queue_bytes",
           .slot = l(&LiveConfig::max_queue_bytes),
           .unit = "bytes per client",
           .range = {1024, 1e12},
           .doc = "The largest amount of answers that a client has not read yet. "
                  "Above it, no frame of this client is computed until it reads."},
          {.name = "max_pending_frames",
           .slot = l(&LiveConfig::max_pending_frames),
           .unit = "frames per client",
           .range = {1, 1000},
           .doc = "The largest number of frames and instants (\"at\") that are received but not answered yet. "
                  "Above it, "
                  "the server reads nothing more from this client until it has answered. In the mode \"free\" a frame "
                  "that waits does not count, since a newer one takes its place."},
          {.name = "max_rate_hz",
           .slot = l(&LiveConfig::max_rate_hz),
           .unit = "messages per second",
           .range = {0.1, 1e6},
           .doc =
               "The largest rate of messages from one client, averaged over a second; messages that come faster wait."},
          {.name = "hello_timeout_s",
           .slot = l(&LiveConfig::hello_timeout_s),
           .unit = "s",
           .range = {0.01, 3600},
           .doc = "Time from the connection to the end of the hello message, which a client sends immediately."},
          {.name = "message_timeout_s",
           .slot = l(&LiveConfig::message_timeout_s),
           .unit = "s",
           .range = {0.01, 3600},
           .doc = "Time from the first byte of a line to its end."},
          {.name = "idle_timeout_s",
           .slot = l(&LiveConfig::idle_timeout_s),
           .unit = "s",
           .range = {0, 1e6},
           .none = "0",
           .doc = "The longest time between two messages of a client that has received all its answers. 0: no limit, "
                  "for simulators that may pause."},
          {.name = "send_timeout_s",
           .slot = l(&LiveConfig::send_timeout_s),
           .unit = "s",
           .range = {0.01, 3600},
           .doc = "A client with unread answers that reads nothing for this time is disconnected."},
      }};
}

Table live_vehicle_table() {
  const auto v = [](auto member) { return at(&Config::live_vehicles, member); };
  return {.name = "live_vehicle",
          .doc =
              "Vehicles whose poses a client sends to `wavetracer serve` at run time; one table per type. "
              "They cannot be combined with trajectories: everything that moves comes from the client.",
          .fields =
              {
                  {.name = "type",
                   .slot = v(&LiveVehicleConfig::type),
                   .doc = "A [[vehicle_type]], or a vehicle class of SUMO; unique. A [[mount]] refers to it in `on`; "
                          "in [links] its antennas are called TYPE.NUMBER/MOUNT."},
                  {.name = "count",
                   .slot = v(&LiveVehicleConfig::count),
                   .unit = "vehicles",
                   .range = {1, 100000},
                   .doc = "The largest number of vehicles of this type at the same time. "
                          "An unused place costs a little memory and no time."},
              },
          .append = append<&Config::live_vehicles>,
          .count = count<&Config::live_vehicles>,
          .optional = true};
}

}  // namespace wavetracer::config
