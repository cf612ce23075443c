// SPDX-License-Identifier: Apache-2.0
// Lets clients_test.py and lost_test.py use the client in C++: each line of standard input is a question ("frame TIME",
// "at TIME..."), each line of standard output what the client returned or threw, as JSON.
// Usage: live_client_probe SERVER TIMEOUT_S RETRIES [RADAR]
#include <iostream>
#include <sstream>
#include <string>

#include "wavetracer/live_client.hpp"

using nlohmann::json;

namespace {

json shown(const wavetracer::LiveChannels& channels) {
  json names = json::array();
  for (size_t k = 0; k < channels.size(); ++k)
    names.push_back({channels.transmitters[channels.tx[k]], channels.receivers[channels.rx[k]]});
  json out = {{"time_s", channels.time_s}, {"names", names}, {"path_gain_db", channels.link("path_gain_db")}};
  if (channels.answer().contains("radars"))
    for (const json& radar : channels.answer().at("radars"))
      out["ranges_m"][radar.at("tx").get<std::string>()] =
          wavetracer::LiveChannels::column<double>(radar.at("detections").at("range_m"));
  return out;
}

// A car that drives northwards with 10 m/s.
json ask(wavetracer::LiveClient& client, const std::string& question) {
  std::istringstream words(question);
  std::string kind;
  double time_s;
  std::vector<double> times_s;
  words >> kind;
  while (words >> time_s) times_s.push_back(time_s);
  json out = json::array();
  if (kind == "at")
    for (const auto& each : client.at_each(times_s)) out.push_back(shown(each));
  else
    out.push_back(shown(client.channels(times_s.at(0), {{{"id", "ego"},
                                                         {"type", "passenger"},
                                                         {"position_m", {3, -60 + 10 * times_s[0], 0}},
                                                         {"yaw_deg", 90},
                                                         {"velocity_m_s", {0, 10, 0}}}})));
  return {{"instants", out}, {"connections", client.connections()}};
}

json error_of(const wavetracer::LiveError& error) { return {{"reason", error.reason()}, {"text", error.what()}}; }

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5) return 2;
  wavetracer::LiveClientOptions options;
  options.server = argv[1];
  options.timeout_s = std::stod(argv[2]);
  options.retries = static_cast<unsigned>(std::stoul(argv[3]));
  if (argc > 4) options.radar = argv[4];
  try {
    wavetracer::LiveClient client(options);
    std::cout << json{{"world", client.world()}} << std::endl;
    for (std::string question; std::getline(std::cin, question);) {
      try {
        std::cout << ask(client, question) << std::endl;
      } catch (const wavetracer::LiveError& error) {
        std::cout << error_of(error) << std::endl;
      }
    }
  } catch (const wavetracer::LiveError& error) {
    std::cout << error_of(error) << std::endl;
  }
  return 0;
}
