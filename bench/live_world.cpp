// SPDX-License-Identifier: Apache-2.0
#include "live_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motion/frame_clock.hpp"
#include "scene/city_traffic.hpp"

namespace wavetracer::bench {
namespace {

constexpr double block_m = 100, kerb_m = 8;  // crossings of the city's streets, and a corner of them

double crossing_m(double at_m) { return block_m * std::round(at_m / block_m) + kerb_m; }

}  // namespace

LiveDrive live_drive(const LiveOptions& options, uint32_t vehicles) {
  const Trajectories traffic =
      generate_traffic(fmt::format("--seed 1 --blocks 6x6 --vehicles {} --seconds {:.3f} --step {:.3f}", vehicles,
                                   options.frames * options.step_s, options.step_s));
  LiveDrive out;
  glm::dvec3 middle(0);  // the middle of the first vehicle's way
  for (uint32_t k = 0; k < options.frames; ++k) {
    nlohmann::json poses = nlohmann::json::array();
    for (const auto& [track, pose] : vehicles_at(traffic, k * options.step_s)) {
      const auto& [p, q, v, w] = pose;
      if (track == 0 && k <= options.frames / 2) middle = p;
      poses.push_back({{"id", traffic.tracks[track].id},
                       {"type", traffic.types[traffic.tracks[track].type].name},
                       {"position_m", {p.x, p.y, p.z}},
                       {"orientation", {q.w, q.x, q.y, q.z}},
                       {"velocity_m_s", {v.x, v.y, v.z}},
                       {"angular_velocity_rad_s", {w.x, w.y, w.z}}});
    }
    out.instants.push_back({k * options.step_s, std::move(poses)});
  }
  if (vehicles > 1) middle = {};
  out.station = fmt::format("[{:.1f}, {:.1f}, 6.0]", crossing_m(middle.x), crossing_m(middle.y));
  return out;
}

std::string live_config(const LiveOptions& options, const LiveDrive& drive, uint32_t vehicles, uint64_t rays) {
  const char* ports = options.matrices() ? "polarization = \"VH\"\n" : "";
  std::string out = fmt::format(
      "[scene]\ngenerate = \"--seed 1 --blocks 6x6\"\n[links]\nmax_distance_m = 150\n[trace]\nrays = {}\n"
      "refresh_rays = {}\nmax_depth = 3\n[live]\nmax_message_bytes = 16777216\n"
      "[[transmitter]]\nname = \"rsu\"\nposition_m = {}\n{}",
      rays, std::min(options.refresh, rays), drive.station, ports);
  for (const auto& [type, height_m] : {std::pair("passenger", 1.6), {"delivery", 3.0}, {"truck", 2.7}})
    out += fmt::format(
        "[[live_vehicle]]\ntype = \"{0}\"\ncount = {1}\n[[mount]]\nname = \"roof-{0}\"\non = \"{0}\"\n"
        "offset_m = [0.0, 0.0, {2}]\n{3}",
        type, vehicles, height_m, ports);
  return out;
}

}  // namespace wavetracer::bench
