// SPDX-License-Identifier: Apache-2.0
// The world of bench_live: the built-in traffic in a generated city, and the configuration of a server for it.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace wavetracer::bench {

struct LiveOptions {
  std::string program, device, protocol = "live", detail = "paths", encoding = "json";
  uint32_t frames = 100, compared = 3;
  uint64_t rays = 100'000, refresh = 3'000, reference_factor = 10;
  double step_s = 0.1;
  bool no_reference = false;

  bool datagrams() const { return protocol == "van3twin"; }
  bool matrices() const { return detail == "matrices"; }
  // The key `detail` of messages: matrices are paths between antennas of two ports.
  std::string asked() const { return matrices() ? "paths" : detail; }
};

struct LiveInstant {
  double time_s;
  nlohmann::json vehicles;  // as in the key of a frame
};

struct LiveDrive {
  std::vector<LiveInstant> instants;
  std::string station;  // its position, as the configuration has it: with one vehicle at the crossing beside its way
};

LiveDrive live_drive(const LiveOptions& options, uint32_t vehicles);
std::string live_config(const LiveOptions& options, const LiveDrive& drive, uint32_t vehicles, uint64_t rays);

}  // namespace wavetracer::bench
