// SPDX-License-Identifier: Apache-2.0
// Checks of [[radar]] that need no ends: names, waveforms, and what radars do not go with.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "config/contradictions.hpp"
#include "config/value_text.hpp"

namespace wavetracer::config {
namespace {

bool names_a_group(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

void check_wave(const RadarConfig& radar, const std::string& key, double carrier_hz, std::vector<Contradiction>& out) {
  const std::string named = fmt::format("[[radar]] {}", toml_string(radar.name));
  if (radar.interval_s && *radar.interval_s < radar.chirp_s)
    out.push_back({{key + ".interval_s", key + ".chirp_s"},
                   fmt::format("{} has interval_s = {:g}, shorter than a chirp of {:g} s: give at least chirp_s", named,
                               *radar.interval_s, radar.chirp_s)});
  if (radar.bandwidth_hz / 2 >= carrier_hz)
    out.push_back({{key, key + ".bandwidth_hz", "radio.frequency_hz", "radio.frequencies_hz"},
                   fmt::format("{} has bandwidth_hz = {:g}: half of it is more than the carrier of {:g} Hz, so a chirp "
                               "would begin below 0 Hz: give less than twice the carrier",
                               named, radar.bandwidth_hz, carrier_hz)});
  if (radar.longest_delay_s() > radar.chirp_s)
    out.push_back(
        {{key, key + ".samples", key + ".bandwidth_hz", key + ".chirp_s"},
         fmt::format("{} has samples = {} and bandwidth_hz = {:g}, so it would hear echoes up to {:g} s late, "
                     "longer than its chirp, chirp_s = {:g}: give fewer samples, a larger bandwidth_hz, or a "
                     "longer chirp_s",
                     named, radar.samples, radar.bandwidth_hz, radar.longest_delay_s(), radar.chirp_s)});
  if (radar.seed && !radar.noise_figure_db)
    out.push_back({{key + ".seed"}, named + " has a seed, but no noise: give noise_figure_db, too, or remove seed"});
  const uint32_t least = 2 * radar.training + 1, cells = std::min(radar.chirps, radar.samples);
  if (radar.guard >= radar.training)
    out.push_back({{key, key + ".guard", key + ".training"},
                   fmt::format("{} has guard = {} and training = {}, so a threshold would have no cell to be made of: "
                               "give a guard below training",
                               named, radar.guard, radar.training)});
  else if (least > cells)
    out.push_back(
        {{key, key + ".training", key + ".chirps", key + ".samples"},
         fmt::format("{} has training = {}, a square of {} x {} cells, but its map has {} x {}: give a smaller "
                     "training, or more chirps and samples",
                     named, radar.training, least, least, radar.chirps, radar.samples)});
}

}  // namespace

void check_radars(const Config& config, std::vector<Contradiction>& out) {
  for (size_t i = 0; i < config.radars.size(); ++i) {
    const RadarConfig& radar = config.radars[i];
    const std::string key = fmt::format("radar.{}", i);
    if (!radar.name.empty() && !names_a_group(radar.name))
      out.push_back({{key + ".name"},
                     fmt::format("radar.name = {} is the name of a group in radar.h5: give one of letters, digits, - "
                                 "and _",
                                 toml_string(radar.name))});
    check_wave(radar, key, config.radio.frequency_hz, out);
    if (!config.output.paths)
      out.push_back(
          {{"output.paths", key}, "[[radar]] needs the paths of links: give output.paths = true, or remove [[radar]]"});
  }
}

}  // namespace wavetracer::config
