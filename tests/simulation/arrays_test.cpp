// SPDX-License-Identifier: Apache-2.0
// Compares arrays with tracing of each element: every element becomes an end of its own, and the paths found there must
// agree with those computed from the path between the centres, as long as the sequences are the same.
#include "wavetracer/arrays.hpp"

#include <map>
#include <numbers>

#include "radio/antenna.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Complex = std::complex<double>;
// The interactions of a path: kinds and surfaces, and for a scattering the tile of its surface.
using Sequence = std::vector<std::tuple<uint8_t, uint32_t, int64_t>>;

Sequence sequence_of(const Paths& paths, size_t row) {
  Sequence out;
  for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k) {
    const glm::dvec3& p = paths.vertex_position_m[k];
    const bool tile = paths.vertex_interaction[k] == scattering;
    out.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k],
                     tile ? std::llround(1e3 * (p.x + 1e3 * p.y + 1e6 * p.z)) : 0);
  }
  return out;
}

// Two walls of a street, the ground, and a screen across half of it, which diffracts.
SceneFile street() {
  return SceneFile(
      std::vector<Part>{{{{{-30, -8, 0}, {60, 0, 0}, {0, 16, 0}}}, "concrete"},
                        {{{{-30, -8, 0}, {60, 0, 0}, {0, 0, 12}}, {{-30, 8, 0}, {60, 0, 0}, {0, 0, 12}}}, "concrete"},
                        {{{{0, -3, 0}, {0, 6, 0}, {0, 0, 4}}}, "metal"}});
}

ArrayConfig panel(uint32_t rows, uint32_t columns) {
  ArrayConfig out;
  out.name = fmt::format("{}x{}", rows, columns);
  out.rows = rows;
  out.columns = columns;
  return out;
}

Config array_config(const std::filesystem::path& scene) {
  Config config = config_of(scene, {{-12, 1.3, 5}}, {{11, -2.1, 1.5}}, 200000, 3);
  config.arrays = {panel(8, 8), panel(4, 2)};
  config.transmitters[0].array = "8x8";
  config.transmitters[0].orientation_deg = {10, 5, 3};
  config.receivers[0].array = "4x2";
  config.receivers[0].orientation_deg = {170, -4, 20};
  config.trace.diffraction = true;
  config.trace.max_diffractions = 2;
  return config;
}

// Returns the same configuration with an end for every element.
Config traced_config(Config config) {
  const auto split = [&](SharedList<RadioEnd>& ends) {
    const RadioEnd centre = ends[0];
    const auto positions = element_positions_m(config, centre);
    ends.clear();
    for (const glm::dvec3& p : positions) {
      RadioEnd end = centre;
      const glm::dvec3 moved = rotation_of(centre.orientation_deg) * p;
      for (int axis = 0; axis < 3; ++axis) end.position_m[static_cast<size_t>(axis)] += moved[axis];
      end.name += fmt::format("/{}", ends.size());
      end.array.clear();
      ends.push_back(end);
    }
  };
  split(config.transmitters);
  split(config.receivers);
  return config;
}

// Two cars with a panel each on a tilted mount, and a bus that drives beside them.
Config drive_config(const std::filesystem::path& scene) {
  Config config;
  config.scene.file = scene.string();
  config.tracks = {{"a", "car", {{0, -20, 0, 0}, {1, -12, 5, 0}, {2, -8, 10, 0}}},
                   {"b", "car", {{0, 20, 0, 0}, {2, 10, 0, 0}}},
                   {"c", "bus", {{0, -6, 14, 0}, {2, 6, 14, 0}}}};
  config.arrays = {panel(2, 3)};
  MountConfig mount;
  mount.name = "roof";
  mount.on = "car";
  mount.offset_m = {0.3, 0.2, 1.7};
  mount.array = "2x3";
  mount.orientation_deg = {30, -10, 5};
  config.mounts = {mount};
  config.vehicle_types = {{"car", "car", 4, 1.8, 1.5, "metal"}, {"bus", "van", 12, 2.5, 3, "metal"}};
  config.time.step_s = 0.5;
  config.trace.rays = 200000;
  config.trace.max_depth = 2;
  return config;
}

// Returns the same configuration with a mount for every element.
Config traced_mounts(Config config) {
  const MountConfig mount = config.mounts[0];
  RadioEnd end;
  end.array = mount.array;
  config.mounts.clear();
  for (const glm::dvec3& p : element_positions_m(config, end)) {
    const glm::dvec3 moved = rotation_of(mount.orientation_deg) * p;
    MountConfig one = mount;
    one.array.clear();
    for (int axis = 0; axis < 3; ++axis) one.offset_m[static_cast<size_t>(axis)] += moved[axis];
    one.name = fmt::format("roof{}", config.mounts.size());
    config.mounts.push_back(one);
  }
  return config;
}

struct PhaseErrors {
  size_t compared = 0;   // pairs of elements, of all paths
  size_t moving = 0;     // number of them that vehicles turn
  double worst_rad = 0;  // largest error of the phase of the delay at the carrier
};

// kinds: kinds of interactions on the paths that are compared.
PhaseErrors compare(const Simulation& simulation, const FrameResult& arrays, const FrameResult& traced, uint8_t kinds) {
  const ElementModel model(simulation);
  std::map<std::tuple<uint32_t, uint32_t, Sequence>, size_t> rows;
  for (size_t row = 0; row < traced.paths.size(); ++row)
    rows[{traced.paths.tx[row], traced.paths.rx[row], sequence_of(traced.paths, row)}] = row;
  PhaseErrors out;
  for (size_t row = 0; row < arrays.paths.size(); ++row) {
    const Sequence sequence = sequence_of(arrays.paths, row);
    uint8_t met = 0;
    for (const auto& [kind, surface, tile] : sequence) met |= kind;
    if ((met & ~kinds) != 0) continue;
    const ElementPaths pairs = model.element_paths(arrays, row);
    bool moving = false;
    for (uint64_t k = arrays.paths.vertex_offset[row]; k < arrays.paths.vertex_offset[row + 1]; ++k)
      moving |= arrays.paths.vertex_instance[k] != no_instance;
    for (uint32_t r = 0; r < pairs.rx_elements; ++r)
      for (uint32_t t = 0; t < pairs.tx_elements; ++t) {
        const auto found = rows.find(
            {pairs.tx_elements * arrays.paths.tx[row] + t, pairs.rx_elements * arrays.paths.rx[row] + r, sequence});
        if (found == rows.end()) continue;
        ++out.compared;
        out.moving += moving;
        const size_t pair = size_t{r} * pairs.tx_elements + t;
        const double late_s = pairs.delay_s[pair] - traced.paths.delay_s[found->second];
        out.worst_rad = std::max(out.worst_rad, std::abs(2 * std::numbers::pi * 5.9e9 * late_s));
      }
  }
  return out;
}

}  // namespace

TEST_CASE("an 8 x 8 panel and a 4 x 2 panel: spherical waves are as if every element had been traced") {
  const SceneFile scene = street();
  const Config config = array_config(scene.path());
  Simulation simulation(config);
  const FrameResult arrays = simulation.run_frame(0);
  const FrameResult traced = run(traced_config(config));
  const PhaseErrors mirrored = compare(simulation, arrays, traced, reflection);
  MESSAGE(mirrored.compared << " pairs of elements, reflections: largest error of the phase " << mirrored.worst_rad
                            << " rad");
  CHECK(mirrored.compared >= 5 * 512);
  CHECK(mirrored.worst_rad < 1e-6);
  const PhaseErrors all = compare(simulation, arrays, traced, reflection | diffraction);
  MESSAGE(all.compared << " pairs of elements, with diffraction: largest error of the phase " << all.worst_rad
                       << " rad");
  CHECK(all.compared > 10 * mirrored.compared);
  CHECK(all.worst_rad < 1e-6);
}

// The error of a plane wave is at most d^2 / (2 r) for a path of length r: the part of |r + d| that is neglected; d:
// distance of the elements of both ends from their centres.
TEST_CASE("plane waves err by the curvature that they leave out, and no more") {
  const SceneFile scene = street();
  Config config = array_config(scene.path());
  config.trace.diffraction = false;
  config.radio.wavefront = "plane";
  Simulation simulation(config);
  const FrameResult arrays = simulation.run_frame(0);
  const PhaseErrors plane = compare(simulation, arrays, run(traced_config(config)), reflection);
  const double wavelength_m = speed_of_light / 5.9e9,
               apart_m = 0.5 * wavelength_m * (std::hypot(3.5, 3.5) + std::hypot(1.5, 0.5)),
               shortest_m = arrays.paths.delay_s[0] * speed_of_light;
  const double bound_rad = 2 * std::numbers::pi / wavelength_m * apart_m * apart_m / (2 * (shortest_m - apart_m));
  MESSAGE("plane waves over " << shortest_m << " m: largest error of the phase " << plane.worst_rad
                              << " rad of at most " << bound_rad);
  CHECK(plane.compared >= 5 * 512);
  CHECK(plane.worst_rad < bound_rad);
  CHECK(plane.worst_rad > 0.1 * bound_rad);
}

TEST_CASE("what is scattered, and what goes through walls, has the exact length between elements") {
  const SceneFile scene(std::vector<Part>{{{{{-30, -8, 0}, {60, 0, 0}, {0, 16, 0}}}, "concrete"},
                                          {{{{-30, 8, 0}, {60, 0, 0}, {0, 0, 12}}}, "brick"},
                                          {{{{0, -3, 0}, {0, 6, 0}, {0, 0, 4}}}, "glass"}});
  Config config = array_config(scene.path());
  config.trace.diffraction = false;
  config.trace.transmission = config.trace.scattering = true;
  config.materials.resize(1);
  config.materials[0].name = "brick";
  config.materials[0].scattering = 0.4;
  config.arrays = {panel(2, 4), panel(4, 2)};
  config.transmitters[0].array = "2x4";
  Simulation simulation(config);
  const FrameResult arrays = simulation.run_frame(0), traced = run(traced_config(config));
  for (const uint8_t kinds : {uint8_t{reflection | transmission}, uint8_t{scattering}}) {
    const PhaseErrors errors = compare(simulation, arrays, traced, kinds);
    CAPTURE(int{kinds});
    CHECK(errors.compared >= 4 * 64);
    CHECK(errors.worst_rad < 1e-6);
  }
}

// The panel turns with its vehicle, and another vehicle is the mirror.
TEST_CASE("arrays on vehicles, and mirrors that are vehicles: as mounts for every element") {
  const SceneFile scene(std::vector<Part>{{{{{-100, -50, 0}, {200, 0, 0}, {0, 100, 0}}}, "concrete"}});
  const Config config = drive_config(scene.path());
  Simulation simulation(config), elements(traced_mounts(config));
  for (const uint32_t frame : {1u, 2u}) {
    simulation.forget();
    elements.forget();
    const PhaseErrors errors = compare(simulation, simulation.run_frame(frame), elements.run_frame(frame), reflection);
    CAPTURE(frame);
    MESSAGE(errors.compared << " pairs of elements on vehicles, " << errors.moving
                            << " of paths that vehicles reflect: largest error of the phase " << errors.worst_rad
                            << " rad");
    CHECK(errors.compared >= 4 * 36);
    CHECK(errors.moving >= 36);
    CHECK(errors.worst_rad < 1e-6);
  }
}
