// SPDX-License-Identifier: Apache-2.0
// A drive in steps of 1 mm into the shadow: the direct path ends at the edge of a screen, others continue, and each
// changes its delay from frame to frame by its Doppler shift.
#include <map>

#include "hard/responses.hpp"

namespace wavetracer::test {
namespace {

constexpr double step_s = 1e-3, speed_m_s = 1;

// A cart without a body behind a screen that ends at x = 0, beside a wall. The shadow boundary is at x = 2.4 m.
Config drive(const SceneFile& file) {
  Config config = config_of(file.path(), {{-3, 5, 2.5}}, {}, 20000, 2);
  config.tracks = {{"cart", "cart", {{0, 2.45, -4, 0}, {0.1, 2.45 - 0.1 * speed_m_s, -4, 0}}}};
  config.vehicle_types.push_back({"cart", "none", 1, 1, 1});
  config.mounts = {{.name = "mast", .role = "receiver", .offset_m = {0, 0, 1.6}, .polarization = "VH"}};
  config.time.step_s = step_s;
  config.trace.diffraction = true;
  config.trace.diffraction_rays = 2000;
  return config;
}

// Rows by the kinds and surfaces of their interactions, which distinguish the paths of one link.
using Rows = std::map<std::vector<uint32_t>, size_t>;
Rows rows_of(const Paths& paths) {
  Rows rows;
  for (size_t i = 0; i < paths.size(); ++i) {
    std::vector<uint32_t> key;
    for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
      key.insert(key.end(), {paths.vertex_interaction[k], paths.vertex_surface[k]});
    rows.emplace(key, i);
  }
  return rows;
}

// Returns the direct wave and its diffraction at the edge x = 0, with the phase of the latter removed, so that no fast
// phase is left.
Response past_the_edge(const Paths& paths) {
  const auto at_edge = [&](size_t i) {
    return kinds_of(paths, i) == "D" && std::abs(paths.vertex_position_m[paths.vertex_offset[i]].x) < 1e-9;
  };
  double edge_s = NAN;
  for (size_t i = 0; i < paths.size(); ++i)
    if (at_edge(i)) edge_s = paths.delay_s[i];
  Response sum{};
  for (size_t i = 0; i < paths.size(); ++i) {
    if (paths.depth[i] > 0 && !at_edge(i)) continue;
    const Complex turn = std::polar(1.0, -2 * pi * frequency_hz * (paths.delay_s[i] - edge_s));
    for (size_t k = 0; k < 4; ++k) sum[k] += paths.a[i][k] * turn;
  }
  return sum;
}

}  // namespace

HardCases drives(const std::string& device) {
  const SceneFile file({{{-40, 0, -30}, {40, 0, 0}, {0, 0, 60}}, {{6, -40, -30}, {0, 80, 0}, {0, 0, 60}}});
  Simulation simulation(drive(file), device);
  const auto frames = static_cast<uint32_t>(simulation.frame_count());
  std::vector<Paths> drive;
  for (uint32_t frame = 0; frame < frames; ++frame) drive.push_back(simulation.run_frame(frame).paths);

  double worst_cycles = 0, worst_jump = 0;
  size_t ends = 0, other_changes = 0;  // changes of the direct path, and of all others, coming or going
  std::vector<Response> h{past_the_edge(drive[0])};
  for (uint32_t frame = 1; frame < frames; ++frame) {
    const Paths &before = drive[frame - 1], &after = drive[frame];
    const Rows rows = rows_of(before), next = rows_of(after);
    for (const auto& [key, i] : rows) {
      const auto found = next.find(key);
      if (found == next.end()) {
        ++(key.empty() ? ends : other_changes);
        continue;
      }
      const size_t j = found->second;
      const double shift_hz = (before.doppler_hz[i] + after.doppler_hz[j]) / 2;
      const double turned = frequency_hz * (after.delay_s[j] - before.delay_s[i]) + shift_hz * step_s;
      worst_cycles = std::max(worst_cycles, std::abs(turned));
    }
    for (const auto& [key, i] : next) other_changes += !rows.contains(key);
    h.push_back(past_the_edge(after));
    if (frame < 2) continue;
    double bend = 0, field = 0;
    for (size_t k = 0; k < 4; ++k) {
      bend += std::norm(h[frame][k] - 2.0 * h[frame - 1][k] + h[frame - 2][k]);
      field += std::norm(h[frame][k]);
    }
    worst_jump = std::max(worst_jump, std::sqrt(bend / field));
  }
  const std::string name = fmt::format("drive of {} steps of 1 mm out of the light", frames - 1);
  return {{name + ", paths", "the direct path ends, once, and nothing else changes",
           ends == 1 ? static_cast<double>(other_changes) : std::numeric_limits<double>::infinity(), 0, "changes"},
          {name + ", Doppler", "phases turn as Doppler shifts say", worst_cycles, 1e-6, "cycles a step"},
          {name + ", field", "what passes the edge does not jump", worst_jump, 1e-4, "of the field"}};
}

}  // namespace wavetracer::test
