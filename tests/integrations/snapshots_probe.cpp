// SPDX-License-Identifier: Apache-2.0
// Lets snapshots_test.py use live_snapshots.hpp, of which the module of integrations/inet is made. Each line of
// standard input is a command as JSON, each line of standard output its answer. Usage: snapshots_probe SERVER KEEP_S
// GAIN
//   {"take": T, "nodes": [{"id", "at", "velocity", "ahead"} or {"station", "at"}...]}  {"gain": [FROM, TO], "time": T}
//   {"forget": T}  {"free_space": [WAVELENGTH_M, DISTANCE_M]}  "coordinates" beside "take"
#include <array>
#include <cmath>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "wavetracer/live_nodes.hpp"
#include "wavetracer/live_snapshots.hpp"

using nlohmann::json;
using wavetracer::LiveVector;

namespace {

wavetracer::LiveSnapshot snapshot(const json& command, const wavetracer::LiveNodes& server,
                                  const wavetracer::LiveCoordinates& coordinates) {
  const auto time_s = command.at("take").get<double>();
  wavetracer::LiveSnapshot out{time_s, time_s, {}, {}, {}};
  for (const json& node : command.at("nodes")) {
    const auto at = node.at("at").get<LiveVector>();
    out.points.push_back(at);
    if (node.contains("station")) {
      out.nodes.push_back(server.station(node.at("station")));
      out.places.emplace_back();
      continue;
    }
    const std::string type = node.value("type", server.first_type());
    out.nodes.push_back(server.vehicle(node.at("id"), type, node.value("mount", "")));
    out.places.push_back(coordinates.place(at, node.at("velocity").get<LiveVector>(),
                                           node.at("ahead").get<LiveVector>(), server.length_m(type)));
  }
  return out;
}

json run(const json& command, wavetracer::LiveNodes& server, wavetracer::LiveSnapshots& snapshots,
         wavetracer::LiveCoordinates& coordinates) {
  if (command.contains("coordinates")) {
    const json& given = command.at("coordinates");
    coordinates = {given.at("offset").get<LiveVector>(), given.at("mirror_y"), given.at("is_front")};
  }
  if (command.contains("take")) snapshots.take(snapshot(command, server, coordinates));
  if (command.contains("forget")) snapshots.forget_before(command.at("forget"));
  json out = {{"snapshots", snapshots.size()}};
  if (command.contains("free_space"))
    out["gain"] = wavetracer::free_space_gain(command.at("free_space")[0], command.at("free_space")[1]);
  if (command.contains("gain")) {
    const auto points = command.at("gain").get<std::array<LiveVector, 2>>();
    const auto time_s =
        command.contains("time") ? std::optional<double>(command.at("time").get<double>()) : std::nullopt;
    const double gain_db = snapshots.gain_db(points[0], points[1], time_s);
    out["gain_db"] = std::isfinite(gain_db) ? json(gain_db) : json();
  }
  out["questions"] = server.questions();
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    wavetracer::LiveClientOptions options;
    options.server = argv[1];
    wavetracer::LiveNodes server(options);
    wavetracer::LiveSnapshots snapshots(server, std::stod(argv[2]), argv[3]);
    wavetracer::LiveCoordinates coordinates;
    for (std::string line; std::getline(std::cin, line);) {
      try {
        std::cout << run(json::parse(line), server, snapshots, coordinates) << std::endl;
      } catch (const std::exception& error) {
        std::cout << json{{"error", error.what()}} << std::endl;
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "snapshots_probe: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
