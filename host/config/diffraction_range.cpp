// SPDX-License-Identifier: Apache-2.0
#include "config/diffraction_range.hpp"

#include <fmt/format.h>

#include <string>

namespace wavetracer::config {
namespace {

// A key that the range does not go with, its value, and why.
struct RangeObstacle {
  const char* key;
  std::string value;
  const char* why;
};

std::vector<RangeObstacle> range_obstacles(const Config& config, const TraceConfig& trace) {
  std::vector<RangeObstacle> out;
  if (config.radio.frequencies_hz.size() > 1)
    out.push_back({"radio.frequencies_hz", fmt::format("{} carriers", config.radio.frequencies_hz.size()),
                   "each carrier would leave out other paths"});
  if (config.output.lifetimes)
    out.push_back({"output.lifetimes", "true", "a path that is left out ends before its geometry does"});
  if (trace.by_spheres()) out.push_back({"trace.reception", "\"sphere\"", "rays decide there which paths there are"});
  if (trace.by_beams())
    out.push_back(
        {"trace.discovery", "\"beams\"", "the certificate would not hold; trace.floor_db does this with beams"});
  return out;
}

}  // namespace

void check_diffraction_range(const Config& config, std::vector<Contradiction>& out) {
  const TraceConfig& trace = config.trace;
  if (!trace.diffraction || trace.diffraction_range_db.value_or(widest_range_db) >= widest_range_db) return;
  for (const RangeObstacle& obstacle : range_obstacles(config, trace))
    out.push_back({{"trace.diffraction_range_db", obstacle.key},
                   fmt::format("trace.diffraction_range_db = {:g} does not go with {} = {}, because {}: remove one of "
                               "them",
                               *trace.diffraction_range_db, obstacle.key, obstacle.value, obstacle.why)});
}

std::optional<double> diffraction_range_of(const Config& config, const TraceConfig& trace) {
  if (!trace.diffraction) return {};
  if (!trace.diffraction_range_db) {
    if (config.output.paths || !range_obstacles(config, trace).empty()) return {};
    return automatic_range_db;
  }
  if (*trace.diffraction_range_db >= widest_range_db) return {};
  return trace.diffraction_range_db;
}

}  // namespace wavetracer::config
