// SPDX-License-Identifier: Apache-2.0
// Antennas at singular places: on a face, an edge, a corner, on each other, and on both ends of a link. The rule: an
// antenna on a surface is not hidden by it and not reflected there, so the wave counts once.
#include "hard/responses.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::test {
namespace {

struct Place {
  const char* name;
  glm::dvec3 at;
  const char* expected;  // kinds of the paths of depth 0 and 1, sorted by delay
};

// A cube of concrete around the origin, 2 m wide, over a ground at z = -3 m.
const glm::dvec3 above{6.13, 5.29, 4.37};
const Place places[] = {{"on a face", {1, 0.2, 0.1}, "LOS R"}, {"on a face that looks away", {-1, 0.2, 0.1}, ""},
                        {"on an edge", {1, 1, 0.1}, "LOS R"},  {"at a corner", {1, 1, 1}, "LOS R"},
                        {"on the ground", {3, -4, -3}, "LOS"}, {"at the other end", above, "R"}};

std::vector<Part> cube_over_ground() {
  return {{reference::box_walls({-1, -1, -1}, {1, 1, 1}), "concrete"},
          {{{{-20, -20, -3}, {40, 0, 0}, {0, 40, 0}}}, "metal"}};
}

Points all_places() {
  Points out;
  for (const Place& place : places) out.push_back(place.at);
  return out;
}

// Tells whether a run warns that the line of sight is left out, and says what to do.
bool tells_to_move(const Config& config, const std::string& device) {
  const FrameResult frame = run(config, device);
  return std::ranges::count(frame.paths.depth, 0u) == 0 && frame.warnings.size() == 1 &&
         frame.warnings[0].find("move the antenna") != std::string::npos;
}

void add_sets(const std::string& device, HardCases& cases) {
  const SceneFile file(cube_over_ground());
  const Paths there = run(config_of(file.path(), {above}, all_places(), 50000, 1), device).paths;
  const Paths back = run(config_of(file.path(), all_places(), {above}, 50000, 1), device).paths;
  for (uint32_t i = 0; i < std::size(places); ++i) {
    HardCase out{fmt::format("receiver {}, and transmitter there", places[i].name),
                 fmt::format("paths \"{}\", the direct one as in free space", places[i].expected), 0, 1e-9, "dB"};
    constexpr double never = std::numeric_limits<double>::infinity();
    if (kinds_between(there, 0, i) != places[i].expected || kinds_between(back, i, 0) != places[i].expected)
      out.measured = never;
    for (const auto& [paths, tx, rx] : {std::tuple{&there, 0u, i}, {&back, i, 0u}})
      for (const size_t row : rows_between(*paths, tx, rx))
        if (paths->depth[row] == 0) {
          // Two orthogonal ports at each end: twice the power.
          const double expected_db = decibels(friis(glm::distance(above, places[i].at)) * std::sqrt(2.0));
          out.measured = std::max(out.measured, std::abs(paths->gain_db[row] - expected_db));
        }
    cases.push_back(out);
  }
}

// All features are on: every path must be finite, and the same from the other end.
void add_all_features(const std::string& device, HardCases& cases) {
  const SceneFile file(cube_over_ground());
  Config config = config_of(file.path(), {above}, all_places(), 50000, 3);
  for (const char* name : {"concrete", "metal"}) {
    config.materials.emplace_back().name = name;
    config.materials.back().scattering = 0.4;
  }
  config.trace.diffraction = config.trace.transmission = config.trace.scattering = true;
  config.trace.diffraction_rays = 50000;
  config.trace.max_diffractions = 2;
  config.trace.tile_m = 2;
  const Paths there = run(config, device).paths;
  std::swap(config.transmitters, config.receivers);
  const Paths back = run(config, device).paths;
  double worst_db = 0;
  for (uint32_t i = 0; i < std::size(places); ++i) {
    const std::vector<size_t> rows = rows_between(there, 0, i), others = rows_between(back, i, 0);
    std::vector<double> gains[2];
    for (const size_t row : rows) gains[0].push_back(there.gain_db[row]);
    for (const size_t row : others) gains[1].push_back(back.gain_db[row]);
    for (std::vector<double>& side : gains) std::sort(side.begin(), side.end());
    if (rows.size() != others.size()) {
      worst_db = std::numeric_limits<double>::infinity();
      continue;
    }
    for (size_t k = 0; k < rows.size(); ++k)
      if (gains[0][k] > -250) worst_db = std::max(worst_db, std::abs(gains[0][k] - gains[1][k]));
  }
  cases.push_back({"all of these places, every feature", "finite numbers alone", not_finite(there) + not_finite(back),
                   0, "values"});
  cases.push_back(
      {"all of these places, every feature, reversed", "the same paths and gains (reciprocity)", worst_db, 1e-6, "dB"});
}

}  // namespace

HardCases surfaces_and_edges(const std::string& device) {
  HardCases cases;
  add_sets(device, cases);
  add_all_features(device, cases);
  const SceneFile file(cube_over_ground());
  const glm::dvec3 beside = above + glm::dvec3{0, 0, 1e-7};
  const bool told = tells_to_move(config_of(file.path(), {above}, {beside}, 1000, 1), device);
  cases.push_back(
      {"receiver 0.1 um from the transmitter", "a warning that says what to do", told ? 0.0 : 1.0, 0, "missing"});
  return cases;
}

}  // namespace wavetracer::test
