// SPDX-License-Identifier: Apache-2.0
// Tests Doppler shifts of diffracted paths: against central differences of exact lengths, which the reference's
// bisection finds on edges that a vehicle moves, and against the delays of the same paths a little earlier and later.
#include "reference/wedge_points.hpp"
#include "simulation/bends.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double frequency_hz = 5.9e9, step_s = 1e-5;

Config traffic(const std::filesystem::path& scene, double time_s) {
  Config config = config_of(scene, {}, {{22, 9.5, 2.2}, {-14, -8.3, 1.4}}, 300000, 3);
  config.trace = diffracting(300000, 3);
  config.trace.max_diffractions = 2;
  config.trace.transmission = true;
  config.trace.reuse = false;
  config.radio.frequency_hz = frequency_hz;
  config.vehicle_types = vehicle_types();
  // Uphill, in a turn, braking.
  config.tracks = {
      {"a", "passenger", {{0, -20, -4, 0}, {1, -9, -3.6, 0.1}, {2, 1, -1, 0.4}, {3, 5, 6, 0.6}, {4, 5.4, 11, 0.6}}},
      {"b", "passenger", {{0, 24, 3, 0}, {1, 14, 3.4, 0}, {2, 8, 3, 0}, {3, 6.5, 2.6, 0}, {4, 6.5, 2.6, 0}}},
      {"lorry", "truck", {{0, -12, 8.6, 0}, {1, -5, 8.2, 0.3}, {2, 0, 5.5, 0.5}, {3, 1, 0, 0.4}, {4, 0, -6, 0}}}};
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {-0.4, 0.2, 1.7}}};
  config.time = {time_s - step_s, time_s + step_s, step_s};
  return config;
}

struct Frames {
  Simulation simulation;
  std::vector<FrameResult> at;
  explicit Frames(const Config& config) : simulation(config) {
    REQUIRE(simulation.frame_count() == 3);
    for (const uint32_t frame : {0u, 1u, 2u}) at.push_back(simulation.run_frame(frame));
  }
  double between_s() const { return simulation.time_s(2) - simulation.time_s(0); }
};

// Ends, interactions, and the vehicles that the surfaces and wedges belong to.
std::map<std::pair<PathKey, std::vector<uint32_t>>, size_t> rows_of(const Paths& paths) {
  std::map<std::pair<PathKey, std::vector<uint32_t>>, size_t> rows;
  for (size_t i = 0; i < paths.size(); ++i) {
    const uint64_t first = paths.vertex_offset[i], end = paths.vertex_offset[i + 1];
    CHECK(rows.emplace(std::pair{PathKey{paths.tx[i], paths.rx[i], part(paths.vertex_interaction, first, end),
                                         part(paths.vertex_surface, first, end)},
                                 part(paths.vertex_instance, first, end)},
                       i)
              .second);
  }
  return rows;
}

// The wedge where a frame has its vehicle.
Wedge placed(const Simulation& simulation, const WorldState& world, uint32_t instance, uint32_t number) {
  if (instance == no_instance) return simulation.scene().wedges[number];
  Wedge wedge = simulation.models()[simulation.instances()[instance].model].wedges[number];
  const Placement& body = world.instances[instance];
  wedge.start = body.position_m + body.rotation * wedge.start;
  wedge.along = body.rotation * wedge.along;
  return wedge;
}

void check_shift(double shift_hz, double expected_hz) {
  CAPTURE(shift_hz);
  CAPTURE(expected_hz);
  CHECK(std::abs(shift_hz - expected_hz) < std::max(1e-4, 1e-6 * std::abs(expected_hz)));
}

}  // namespace

TEST_CASE("over one moving edge, or two: the shift is that of the exact length") {
  const SceneFile file(street());
  size_t moving = 0, pairs = 0;
  for (const double time_s : {0.63, 1.81}) {
    const Frames frames(traffic(file.path(), time_s));
    const Paths& paths = frames.at[1].paths;
    for (size_t i = 0; i < paths.size(); ++i) {
      const uint64_t first = paths.vertex_offset[i], end = paths.vertex_offset[i + 1];
      const std::vector<uint8_t> kinds = part(paths.vertex_interaction, first, end);
      if (kinds.empty() || kinds.size() > 2 || std::ranges::count(kinds, diffraction) != std::ssize(kinds)) continue;
      double length_m[2];
      bool on_edges = true;
      for (const size_t side : {0u, 1u}) {
        const WorldState& world = frames.at[2 * side].world;
        const glm::dvec3 a = world.transmitters[paths.tx[i]].position_m, b = world.receivers[paths.rx[i]].position_m;
        std::vector<Wedge> wedges;
        for (uint64_t k = first; k < end; ++k)
          wedges.push_back(placed(frames.simulation, world, paths.vertex_instance[k], paths.vertex_surface[k]));
        Points points;
        if (wedges.size() == 1) {
          if (const auto p = reference::diffraction_point(wedges[0], a, b)) points = {*p};
        } else if (const auto p = reference::diffraction_points(wedges[0], wedges[1], a, b)) {
          points.assign(p->begin(), p->end());
        }
        on_edges = on_edges && !points.empty();
        if (!on_edges) break;
        points.push_back(b);
        length_m[side] = glm::distance(a, points[0]);
        for (size_t k = 1; k < points.size(); ++k) length_m[side] += glm::distance(points[k - 1], points[k]);
      }
      if (!on_edges) continue;
      check_shift(paths.doppler_hz[i],
                  -frequency_hz * (length_m[1] - length_m[0]) / speed_of_light / frames.between_s());
      moving += by_vehicle(paths, i);
      pairs += kinds.size() == 2;
    }
  }
  CHECK(moving > 50);
  CHECK(pairs > 50);
}

TEST_CASE("among reflections and transmissions: the shift is that of the delay") {
  const SceneFile file(street());
  size_t checked = 0, diffracted = 0, mixed = 0, all = 0;
  double largest_hz = 0;
  for (const double time_s : {1.37, 2.44}) {
    const Frames frames(traffic(file.path(), time_s));
    const auto before = rows_of(frames.at[0].paths), after = rows_of(frames.at[2].paths);
    const Paths& paths = frames.at[1].paths;
    all += paths.size();
    for (const auto& [key, i] : rows_of(paths)) {
      if (!before.contains(key) || !after.contains(key)) continue;
      CAPTURE(to_string(key.first));
      const double change_s = frames.at[2].paths.delay_s[after.at(key)] - frames.at[0].paths.delay_s[before.at(key)];
      check_shift(paths.doppler_hz[i], -frequency_hz * change_s / frames.between_s());
      largest_hz = std::max(largest_hz, std::abs(paths.doppler_hz[i]));
      diffracted += has(key.first, diffraction);
      mixed += has(key.first, diffraction) && (has(key.first, reflection) || has(key.first, transmission));
      ++checked;
    }
  }
  CHECK(static_cast<double>(checked) > 0.97 * static_cast<double>(all));
  CHECK(diffracted > 500);
  CHECK(mixed > 200);
  CHECK(largest_hz > 300);
}
