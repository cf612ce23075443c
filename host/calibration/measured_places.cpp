// SPDX-License-Identifier: Apache-2.0
// Places that several points share are one receiver.
#include "calibration/measured_places.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include "base/spelling.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

void check_ends(const Config& config) {
  if (config.transmitters.empty())
    throw ConfigError(config.file + ": a [[transmitter]] is needed, whose level was measured");
  if (config.receivers.size() > 1)
    throw ConfigError(fmt::format(
        "{}: it has {} [[receiver]] tables; measured places take the antenna of a single one, so keep one of them",
        config.file, config.receivers.size()));
  if (!config.receiver_grids.empty() || !config.stations.empty() || !config.mounts.empty())
    throw ConfigError(config.file +
                      ": measured places are the only receivers; remove [[receiver_grid]], [[station]] and [[mount]] "
                      "tables");
  if (config.trace.by_spheres())
    throw ConfigError(config.file + ": trace.reception = \"sphere\" has no exact paths to fit");
}

// Returns the receiver at a measured place. pattern: the receiver that gives its antenna and height, or nullptr.
RadioEnd receiver_at(const MeasuredFile& file, const MeasuredPoint& point, const RadioEnd* pattern) {
  RadioEnd out = pattern ? *pattern : RadioEnd{};
  std::array<double, 3> place = point.position;
  if (!file.has_z) {
    const bool geographic = pattern && pattern->position_wgs84;
    if (!pattern || geographic != file.degrees)
      throw InputError(fmt::format(
          "{}: there is no column {}: add it, or give the height by a [[receiver]] of the configuration with {}",
          file.file, file.degrees ? "height_m" : "z_m", file.degrees ? "position_wgs84" : "position_m"));
    place[2] = geographic ? (*pattern->position_wgs84)[2] : pattern->position_m[2];
  }
  out.position_wgs84.reset();
  if (file.degrees)
    out.position_wgs84 = place;
  else
    out.position_m = place;
  return out;
}

uint32_t transmitter_of(const MeasuredFile& file, const MeasuredPoint& point, const Config& config) {
  std::vector<std::string> names;
  for (const RadioEnd& end : config.transmitters) names.push_back(end.name);
  if (point.tx.empty()) {
    if (names.size() == 1) return 0;
    throw InputError(
        fmt::format("{}:{}: the configuration has {} transmitters: name the one of each row in a column tx", file.file,
                    point.line, names.size()));
  }
  const auto found = std::ranges::find(names, point.tx);
  if (found == names.end())
    throw InputError(fmt::format("{}:{}: tx = '{}' is no transmitter of the configuration{}", file.file, point.line,
                                 point.tx, spelling_hint(point.tx, names)));
  return static_cast<uint32_t>(found - names.begin());
}

// Replaces the receivers by the measured places, and returns the link of each point.
std::vector<Link> place_receivers(Config& config, const std::vector<MeasuredFile>& files) {
  const std::optional<RadioEnd> pattern =
      config.receivers.empty() ? std::nullopt : std::optional(std::as_const(config.receivers)[0]);
  std::vector<RadioEnd> ends;
  std::vector<Link> links;
  std::map<std::pair<bool, std::array<double, 3>>, uint32_t> known;
  for (const MeasuredFile& file : files)
    for (const MeasuredPoint& point : file.points) {
      RadioEnd end = receiver_at(file, point, pattern ? &*pattern : nullptr);
      const auto [at, added] = known.try_emplace({file.degrees, end.position_wgs84.value_or(end.position_m)},
                                                 static_cast<uint32_t>(ends.size()));
      if (added) {
        end.name = fmt::format("{}:{}", file.file, point.line);
        ends.push_back(std::move(end));
      }
      links.push_back({transmitter_of(file, point, config), at->second});
    }
  config.receivers = std::move(ends);
  return links;
}

}  // namespace

MeasuredPlaces measured_places(Config config, const std::vector<MeasuredFile>& files) {
  check_ends(config);
  config.cache.kind = "none";
  config.output.waypoints = 0;
  config.output.paths = true;
  std::vector<Link> links = place_receivers(config, files);
  config.text = echoed_config(config);
  return {std::move(config), std::move(links)};
}

}  // namespace wavetracer::calibration
