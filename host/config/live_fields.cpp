// Rows of the field table about live coupling: the vehicles that clients of `wavetracer serve` may bring, and limits.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table live_table() {
  const auto l = [](auto member) { return at(&Config::live, member); };
  return {
      .name = "live",
      .doc = "What `wavetracer serve` accepts of its clients. A client that goes beyond is told so, or dropped.",
      .fields = {
          {.name = "margin_m",
           .slot = l(&LiveConfig::margin_m),
           .unit = "m",
           .range = {0, 1e5},
           .doc = "Vehicles may be as far outside of the scene's box, in x, y and z. Farther out, float32 discovery "
                  "would grow coarse for all."},
          {.name = "max_clients",
           .slot = l(&LiveConfig::max_clients),
           .range = {1, 1000},
           .doc = "That have said hello, at once. They share the device frame by frame, in turn."},
          {.name = "max_strangers",
           .slot = l(&LiveConfig::max_strangers),
           .range = {1, 1000},
           .doc = "Connections that have not said hello yet, at once. When one more comes, the one that has waited "
                  "longest "
                  "gives way: connections that say nothing keep nobody out."},
          {.name = "max_message_bytes",
           .slot = l(&LiveConfig::max_message_bytes),
           .unit = "bytes a line",
           .range = {1024, 1073741824.0},
           .doc = "Of a message to the server. A pose takes 100 to 250."},
          {.name = "max_queue_bytes",
           .slot = l(&LiveConfig::max_queue_bytes),
           .unit = "bytes a client",
           .range = {1024, 1e12},
           .doc = "Of answers that a client has not read: beyond, none of its frames is solved until it reads."},
          {.name = "max_pending_frames",
           .slot = l(&LiveConfig::max_pending_frames),
           .unit = "frames a client",
           .range = {1, 1000},
           .doc = "Received and not answered; then the server stops reading from that client until it has answered."},
          {.name = "max_rate_hz",
           .slot = l(&LiveConfig::max_rate_hz),
           .unit = "messages a second",
           .range = {0.1, 1e6},
           .doc = "Of a client, on average over a second; what comes faster waits."},
          {.name = "hello_timeout_s",
           .slot = l(&LiveConfig::hello_timeout_s),
           .unit = "s",
           .range = {0.01, 3600},
           .doc = "From connecting to the end of hello, which a program says at once."},
          {.name = "message_timeout_s",
           .slot = l(&LiveConfig::message_timeout_s),
           .unit = "s",
           .range = {0.01, 3600},
           .doc = "From the first byte of a line to its end."},
          {.name = "idle_timeout_s",
           .slot = l(&LiveConfig::idle_timeout_s),
           .unit = "s",
           .range = {0, 1e6},
           .none = "0",
           .doc = "Between messages of a client that owes the next one. 0: no end, for simulators that may pause."},
          {.name = "send_timeout_s",
           .slot = l(&LiveConfig::send_timeout_s),
           .unit = "s",
           .range = {0.01, 3600},
           .doc = "A client that has answers to read and takes no byte for so long is dropped."},
      }};
}

Table live_vehicle_table() {
  const auto v = [](auto member) { return at(&Config::live_vehicles, member); };
  return {.name = "live_vehicle",
          .doc =
              "Places for vehicles whose poses come at run time, to `wavetracer serve`; one table a type. They "
              "exclude trajectories: everything that moves comes from the client.",
          .fields =
              {
                  {.name = "type",
                   .slot = v(&LiveVehicleConfig::type),
                   .doc = "A [[vehicle_type]], or a vehicle class of SUMO; unique. [[mount]] names it in `on`, "
                          "[links] as TYPE.NUMBER/MOUNT."},
                  {.name = "count",
                   .slot = v(&LiveVehicleConfig::count),
                   .unit = "vehicles",
                   .range = {1, 100000},
                   .doc = "At most at once. A place that is empty costs a little memory and no time."},
              },
          .append = append<&Config::live_vehicles>,
          .count = count<&Config::live_vehicles>,
          .optional = true};
}

}  // namespace wavetracer::config
