// Arrays against tracing: every element is made an end of its own, and what is found there is what the path between the
// centres says of these elements, as long as the sequences are the same.
#include "wavetracer/arrays.hpp"

#include <map>
#include <numbers>

#include "radio/antenna.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Complex = std::complex<double>;
// What a path has met: kinds and surfaces.
using Sequence = std::vector<std::pair<uint8_t, uint32_t>>;

Sequence sequence_of(const Paths& paths, size_t row) {
  Sequence out;
  for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k)
    out.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k]);
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

// The same with an end for every element.
Config traced_config(Config config) {
  const auto split = [&](std::vector<RadioEnd>& ends) {
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

struct PhaseErrors {
  size_t compared = 0;   // pairs of elements, of all paths
  double worst_rad = 0;  // of the phase of the delay at the carrier
};

// kinds: of the interactions of the paths that are compared.
PhaseErrors compare(const Simulation& simulation, const FrameResult& arrays, const FrameResult& traced, uint8_t kinds) {
  const ElementModel model(simulation);
  std::map<std::tuple<uint32_t, uint32_t, Sequence>, size_t> rows;
  for (size_t row = 0; row < traced.paths.size(); ++row)
    rows[{traced.paths.tx[row], traced.paths.rx[row], sequence_of(traced.paths, row)}] = row;
  PhaseErrors out;
  for (size_t row = 0; row < arrays.paths.size(); ++row) {
    const Sequence sequence = sequence_of(arrays.paths, row);
    uint8_t met = 0;
    for (const auto& [kind, surface] : sequence) met |= kind;
    if ((met & ~kinds) != 0) continue;
    const ElementPaths pairs = model.element_paths(arrays, row);
    for (uint32_t r = 0; r < pairs.rx_elements; ++r)
      for (uint32_t t = 0; t < pairs.tx_elements; ++t) {
        const auto found = rows.find({t, r, sequence});
        if (found == rows.end()) continue;
        ++out.compared;
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
  CHECK(mirrored.compared > 5000);
  CHECK(mirrored.worst_rad < 1e-6);
  const PhaseErrors all = compare(simulation, arrays, traced, reflection | diffraction);
  MESSAGE(all.compared << " pairs of elements, with diffraction: largest error of the phase " << all.worst_rad
                       << " rad");
  CHECK(all.compared > 2 * mirrored.compared);
  CHECK(all.worst_rad < 1e-6);
}
