// SPDX-License-Identifier: Apache-2.0
// Checks of places that need the whole configuration: places in degrees, and air whose models are valid at each
// carrier.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "config/contradictions.hpp"
#include "config/value_text.hpp"

namespace wavetracer::config {

// Ranges are those of the recommendations. fog: P.840 assumes Rayleigh scattering.
void check_air(const Config& config, std::vector<Contradiction>& out) {
  std::vector<double> carriers = config.radio.frequencies_hz;
  carriers.push_back(config.radio.frequency_hz);
  const auto check = [&](bool on, const char* key, const char* recommendation, double from_hz, double to_hz) {
    if (!on) return;
    for (const double hz : carriers)
      if (hz < from_hz || hz > to_hz)
        out.push_back({{std::string("air.") + key, "radio.frequency_hz"},
                       fmt::format("air.{}: ITU-R {} is known from {:g} to {:g} GHz, but a carrier is {:g} GHz: "
                                   "remove air.{}",
                                   key, recommendation, from_hz / 1e9, to_hz / 1e9, hz / 1e9, key)});
  };
  check(config.air.rain_mm_h > 0, "rain_mm_h", "P.838-3", 1e9, 1e12);
  check(config.air.gases, "gases", "P.676-13", 1e9, 1e12);
  check(config.air.fog_g_m3 > 0, "fog_g_m3", "P.840-8", 0, 200e9);
}

void check_degrees(const Config& config, std::vector<Contradiction>& out) {
  const auto check = [&](const std::string& key, double latitude, double longitude) {
    if (std::abs(latitude) > 90 || std::abs(longitude) > 180)
      out.push_back({{key},
                     fmt::format("latitude {} and longitude {} are no place on the earth: give the latitude first, "
                                 "from -90 to 90 degrees, then the longitude, from -180 to 180",
                                 latitude, longitude)});
  };
  const auto check_all = [&](const char* table, const std::vector<RadioEnd>& ends) {
    for (size_t i = 0; i < ends.size(); ++i)
      if (const auto& p = ends[i].position_wgs84)
        check(fmt::format("{}.{}.position_wgs84", table, i), (*p)[0], (*p)[1]);
  };
  check_all("transmitter", config.transmitters);
  check_all("receiver", config.receivers);
  check_all("station", config.stations);
  for (size_t i = 0; i < config.tracks.size(); ++i)
    for (const auto& p : config.tracks[i].waypoints_wgs84)
      check(fmt::format("track.{}.waypoints_wgs84", i), p[1], p[2]);
  for (size_t i = 0; i < config.receiver_grids.size(); ++i) {
    const ReceiverGridConfig& grid = config.receiver_grids[i];
    if (const auto& p = grid.south_west_wgs84)
      check(fmt::format("receiver_grid.{}.south_west_wgs84", i), (*p)[0], (*p)[1]);
    if (const auto& p = grid.north_east_wgs84)
      check(fmt::format("receiver_grid.{}.north_east_wgs84", i), (*p)[0], (*p)[1]);
  }
}

void check_grid_corners(const Config& config, std::vector<Contradiction>& out) {
  for (size_t i = 0; i < config.receiver_grids.size(); ++i) {
    const ReceiverGridConfig& grid = config.receiver_grids[i];
    const auto check = [&](const char* corner, bool in_degrees, const char* border, bool in_metres) {
      if (in_degrees && in_metres)
        out.push_back({{fmt::format("receiver_grid.{}.{}", i, corner), fmt::format("receiver_grid.{}.{}", i, border)},
                       fmt::format("[[receiver_grid]] has both {} and {}: remove one of them", border, corner)});
    };
    check("south_west_wgs84", grid.south_west_wgs84.has_value(), "x_min_m", grid.x_min_m.has_value());
    check("south_west_wgs84", grid.south_west_wgs84.has_value(), "y_min_m", grid.y_min_m.has_value());
    check("north_east_wgs84", grid.north_east_wgs84.has_value(), "x_max_m", grid.x_max_m.has_value());
    check("north_east_wgs84", grid.north_east_wgs84.has_value(), "y_max_m", grid.y_max_m.has_value());
  }
}

}  // namespace wavetracer::config
