// SPDX-License-Identifier: Apache-2.0
// A client of `wavetracer serve` in C++: two cars meet at a crossing, and the channel from one to the other is printed
// at ten instants of every step. It needs C++17, nlohmann's json (Debian: nlohmann-json3-dev), and the headers
// wavetracer/live_client.hpp and wavetracer/live_socket.hpp, which may be copied into a simulator.
//
//     g++ -std=c++17 -O2 -Iinclude docs/examples/live_client.cpp -o live_client
//     wavetracer serve -c configs/live.toml &
//     ./live_client [tcp:127.0.0.1:7710 | unix:PATH] [STEPS]
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "wavetracer/live_client.hpp"

using nlohmann::json;

// The strongest path of the first link that has paths.
void print_strongest(const wavetracer::LiveChannels& channels) {
  const std::vector<double> gain_db = channels.path("gain_db"), delay_s = channels.path("delay_s");
  const std::vector<double> doppler_hz = channels.path("doppler_hz");
  const auto begin = std::find_if(channels.paths.begin(), channels.paths.end(), [](auto count) { return count > 0; });
  if (begin == channels.paths.end()) {
    std::printf("%.3f s: no link has a path\n", channels.time_s);
    return;
  }
  const auto link = static_cast<size_t>(begin - channels.paths.begin());
  const auto best = static_cast<size_t>(std::max_element(gain_db.begin(), gain_db.begin() + *begin) - gain_db.begin());
  std::printf("%.3f s: %s -> %s: %u paths, the strongest has %.3f dB, %.3f ns, %.2f Hz\n", channels.time_s,
              channels.transmitters[channels.tx[link]].c_str(), channels.receivers[channels.rx[link]].c_str(), *begin,
              gain_db[best], 1e9 * delay_s[best], doppler_hz[best]);
}

int main(int argc, char** argv) try {
  const double step_s = 0.1, speed_m_s = 14;
  const int steps = argc > 2 ? std::stoi(argv[2]) : 5, instants = 10;
  wavetracer::LiveClientOptions options;
  if (argc > 1) options.server = argv[1];
  options.detail = "paths";
  wavetracer::LiveClient client(options);
  std::printf("%s on %s\n", client.world().at("server").get<std::string>().c_str(),
              client.world().at("device").get<std::string>().c_str());
  for (int step = 0; step < steps; ++step) {
    const double from_s = (step - 1) * step_s, to_s = step * step_s, way_m = speed_m_s * to_s;
    const json east = {{"id", "eastwards"},
                       {"type", "passenger"},
                       {"position_m", {-60 + way_m, -3, 0}},
                       {"yaw_deg", 0},
                       {"velocity_m_s", {speed_m_s, 0, 0}}};
    const json north = {{"id", "northwards"},
                        {"type", "passenger"},
                        {"position_m", {3, -60 + way_m, 0}},
                        {"yaw_deg", 90},
                        {"velocity_m_s", {0, speed_m_s, 0}}};
    const wavetracer::LiveChannels channels = client.channels(to_s, json::array({east, north}));
    std::vector<double> times_s;
    for (int k = 1; step > 0 && k <= instants; ++k)
      times_s.push_back(std::min(to_s, from_s + k * (to_s - from_s) / instants));
    if (step == 0) print_strongest(channels);
    for (const wavetracer::LiveChannels& each : client.at_each(times_s)) print_strongest(each);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "live_client: %s\n", error.what());
  return 1;
}
