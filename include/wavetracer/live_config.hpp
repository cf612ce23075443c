// SPDX-License-Identifier: Apache-2.0
// [[live_vehicle]] and [live] of the configuration: input at run time.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace wavetracer {

struct LiveVehicleConfig {  // [[live_vehicle]]: places for vehicles of one type, filled at run time by `wavetracer
                            // serve`
  std::string type = "passenger";
  uint32_t count = 1;
};

struct LiveConfig {                      // [live]: what `wavetracer serve` accepts
  double margin_m = 100;                 // largest distance of vehicles from the scene's box
  uint32_t max_clients = 8;              // connections that have said hello
  uint32_t max_strangers = 8;            // connections that have not said hello
  uint64_t max_message_bytes = 1048576;  // limit of one line
  uint64_t max_queue_bytes = 67108864;   // limit of unread answers, per client
  uint32_t max_pending_frames = 4;       // frames per client that are not answered yet
  double max_rate_hz = 1000;             // messages per second and client
  double hello_timeout_s = 3;            // from the connection to the end of hello
  double message_timeout_s = 5;          // from the first byte of a line to its end
  std::optional<double> idle_timeout_s = 300;
  double send_timeout_s = 10;  // time without reading any byte of its answers
};

}  // namespace wavetracer
