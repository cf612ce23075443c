// SPDX-License-Identifier: Apache-2.0
// Places, antennas and orientations that several points share are one receiver.
#include "calibration/measured_places.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include "base/spelling.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

// Checks and changes what measured places take the part of.
void make_room_for_places(Config& config) {
  const std::string& file = config.file;
  if (config.transmitters.empty()) throw ConfigError(file + ": a [[transmitter]] is needed, whose level was measured");
  if (!config.receiver_grids.empty() || !config.stations.empty() || !config.mounts.empty())
    throw ConfigError(file +
                      ": measured places are the only receivers; remove [[receiver_grid]], [[station]] and [[mount]] "
                      "tables");
  if (config.trace.by_spheres()) throw ConfigError(file + ": trace.reception = \"sphere\" has no exact paths to fit");
  config.cache.kind = "none";
  config.output.waypoints = 0;
  config.output.paths = true;
}

std::vector<std::string> names_of(const std::vector<RadioEnd>& ends) {
  std::vector<std::string> out;
  for (const RadioEnd& end : ends) out.push_back(end.name);
  return out;
}

// Returns the number of the end that the row names, or of the only end. kind: its column and its table.
size_t named_end(const std::vector<RadioEnd>& ends, const std::string& name, const MeasuredFile& file,
                 const MeasuredPoint& point, std::pair<const char*, const char*> kind) {
  const std::vector<std::string> names = names_of(ends);
  if (name.empty() && names.size() == 1) return 0;
  if (name.empty())
    throw InputError(fmt::format("{}:{}: the configuration has {} {}s: name the one of each row in a column {}",
                                 file.file, point.line, names.size(), kind.second, kind.first));
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError(fmt::format("{}:{}: {} = '{}' is no {} of the configuration{}", file.file, point.line, kind.first,
                                 name, kind.second, spelling_hint(name, names)));
  return static_cast<size_t>(found - names.begin());
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
  const std::array turns{point.yaw_deg, point.pitch_deg, point.roll_deg};
  for (size_t i = 0; i < turns.size(); ++i) out.orientation_deg[i] = turns[i].value_or(out.orientation_deg[i]);
  return out;
}

// Collects receivers, each once.
class Receivers {
 public:
  explicit Receivers(std::vector<RadioEnd> patterns) : patterns_(std::move(patterns)) {}

  uint32_t number_of(const MeasuredFile& file, const MeasuredPoint& point) {
    const bool any = !patterns_.empty() || !point.rx.empty();
    const size_t pattern = any ? named_end(patterns_, point.rx, file, point, {"rx", "receiver"}) : 0;
    RadioEnd end = receiver_at(file, point, any ? &patterns_[pattern] : nullptr);
    const auto [at, added] =
        known_.try_emplace({pattern, file.degrees, end.position_wgs84.value_or(end.position_m), end.orientation_deg},
                           static_cast<uint32_t>(ends.size()));
    if (added) {
      end.name = fmt::format("{}:{}", file.file, point.line);
      ends.push_back(std::move(end));
    }
    return at->second;
  }

  std::vector<RadioEnd> ends;

 private:
  std::vector<RadioEnd> patterns_;
  std::map<std::tuple<size_t, bool, std::array<double, 3>, std::array<double, 3>>, uint32_t> known_;
};

}  // namespace

MeasuredPlaces measured_places(Config config, const std::vector<MeasuredFile>& files) {
  make_room_for_places(config);
  const auto& given = std::as_const(config);
  const std::vector<RadioEnd> transmitters(given.transmitters.begin(), given.transmitters.end());
  Receivers receivers({given.receivers.begin(), given.receivers.end()});
  std::vector<Link> links;
  for (const MeasuredFile& each : files)
    for (const MeasuredPoint& point : each.points)
      links.push_back({static_cast<uint32_t>(named_end(transmitters, point.tx, each, point, {"tx", "transmitter"})),
                       receivers.number_of(each, point)});
  config.receivers = std::move(receivers.ends);
  config.text = echoed_config(config);
  return {std::move(config), std::move(links)};
}

}  // namespace wavetracer::calibration
