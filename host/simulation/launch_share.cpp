// SPDX-License-Identifier: Apache-2.0
// The shares of the directions, and the numbers of rays in full launches.
#include "simulation/launch_share.hpp"

#include <algorithm>
#include <numeric>

namespace wavetracer {

namespace {

constexpr uint64_t compiling_rays = 4096;  // rays of each launcher
constexpr uint64_t refreshed_share = 10;   // one in this many directions is launched in a warm frame by default

}  // namespace

DirectionShare share_of(uint64_t rays, std::optional<uint64_t> refresh_rays, uint64_t warm_frames) {
  if (warm_frames == 0) return {};
  const uint64_t wanted = std::max<uint64_t>(refresh_rays.value_or(rays / refreshed_share), 1);
  const uint64_t stride = std::max<uint64_t>(rays / wanted, 1);
  auto step = static_cast<uint64_t>(0.6180339887498949 * static_cast<double>(stride)) + 1;
  while (std::gcd(step, stride) != 1) ++step;
  return {warm_frames * step % stride, stride};
}

uint64_t listener_rays(const TraceConfig& trace) {
  const uint64_t unasked = std::max<uint64_t>(*trace.rays / 10, 100000);
  return std::min(trace.diffraction_rays.value_or(unasked), *trace.rays);
}

std::vector<Launch> frame_launches(const TraceConfig& trace, std::vector<Launcher> transmitters,
                                   std::vector<Launcher> listeners, uint64_t warm_frames) {
  std::vector<Launch> out;
  out.push_back({.who = std::move(transmitters),
                 .rays = *trace.rays,
                 .share = share_of(*trace.rays, trace.refresh_rays, warm_frames)});
  if (listeners.empty()) return out;
  const uint64_t rays = listener_rays(trace);
  out.push_back({.who = std::move(listeners),
                 .rays = rays,
                 .share = share_of(rays, {}, warm_frames),
                 .followed = false,
                 .sorted = false});
  return out;
}

DirectionShare few_directions(uint64_t rays) { return {0, std::max<uint64_t>(rays / compiling_rays, 1)}; }

}  // namespace wavetracer
