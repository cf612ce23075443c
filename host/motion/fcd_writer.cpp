// SPDX-License-Identifier: Apache-2.0
// Writes the samples of all tracks by time and then by track.
// Times that agree to a microsecond are one timestep.
#include "motion/fcd_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>

#include "base/xml_text.hpp"
#include "motion/track_motion.hpp"

namespace wavetracer {
std::string format_fcd(const Trajectories& trajectories) {
  constexpr double degrees = 180 / std::numbers::pi;
  std::vector<std::tuple<int64_t, size_t, size_t>> order;  // microseconds, track, sample
  for (size_t t = 0; t < trajectories.tracks.size(); ++t) {
    const std::vector<Sample>& samples = trajectories.tracks[t].samples;
    for (size_t k = 0; k < samples.size(); ++k) order.emplace_back(std::llround(samples[k].time_s * 1e6), t, k);
  }
  std::sort(order.begin(), order.end());

  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fcd-export>\n";
  const auto put = std::back_inserter(out);
  for (size_t i = 0; i < order.size(); ++i) {
    const auto& [microseconds, t, k] = order[i];
    if (i == 0 || std::get<0>(order[i - 1]) != microseconds) {
      if (i > 0) out += "  </timestep>\n";
      fmt::format_to(put, "  <timestep time=\"{:.6f}\">\n", static_cast<double>(microseconds) / 1e6);
    }
    const Track& track = trajectories.tracks[t];
    const VehicleType& type = trajectories.types[track.type];
    const Sample& s = track.samples[k];
    const glm::dvec3 bumper_m = s.position_m + type.length_m / 2 * heading(s.yaw_rad, s.pitch_rad);
    const double angle_deg = 90 - s.yaw_rad * degrees;
    fmt::format_to(put,
                   "    <vehicle id=\"{}\" x=\"{:.6f}\" y=\"{:.6f}\" z=\"{:.6f}\" angle=\"{:.6f}\" type=\"{}\" "
                   "speed=\"{:.6f}\" slope=\"{:.6f}\"/>\n",
                   xml_text(track.id), bumper_m.x, bumper_m.y, bumper_m.z,
                   angle_deg - 360 * std::floor(angle_deg / 360), xml_text(type.name), s.speed_m_s,
                   s.pitch_rad * degrees);
  }
  return out + (order.empty() ? "" : "  </timestep>\n") + "</fcd-export>\n";
}

}  // namespace wavetracer
