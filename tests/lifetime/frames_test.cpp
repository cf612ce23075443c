// SPDX-License-Identifier: Apache-2.0
// Lifetimes of the paths of frames: no path is missing in a frame whose ends and bodies have moved by less.
// WAVETRACER_RANDOM_SCENES=30 tries as many towns as that with each set of features.
#include "lifetime/path_lifetimes.hpp"

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "passes/triangles.hpp"
#include "simulation/buildings.hpp"
#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A path by what it touches; two paths of a link differ in it.
using Touched = std::vector<std::tuple<uint8_t, uint32_t, uint32_t>>;

Touched touched(const Paths& paths, size_t row) {
  Touched out;
  for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k)
    out.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k], paths.vertex_instance[k]);
  return out;
}

std::set<Touched> paths_of_link(const Paths& paths, uint32_t tx, uint32_t rx) {
  std::set<Touched> out;
  for (size_t row = 0; row < paths.size(); ++row)
    if (paths.tx[row] == tx && paths.rx[row] == rx) out.insert(touched(paths, row));
  return out;
}

struct Features {
  bool diffraction = false, transmission = false;
};

std::vector<Quad> town(Random& random) {
  std::vector<Quad> out{{{-25, -25, 0}, {50, 0, 0}, {0, 50, 0}}};
  for (int k = 0; k < 6; ++k) {
    const glm::dvec3 corner{random.between(-16, 12), random.between(-16, 12), 0};
    const auto box =
        building(corner, random.between(0, 1.5), random.between(2, 7), random.between(2, 7), random.between(2, 8));
    out.insert(out.end(), box.begin(), box.end());
  }
  return out;
}

Config town_config(const SceneFile& file, const Points& from, const Points& to, const Features& features) {
  Config config = config_of(file.path(), from, to, 1000, 3);
  config.trace.discovery = "beams";
  config.trace.diffraction = features.diffraction;
  config.trace.transmission = features.transmission;
  config.trace.max_transmissions = 2;
  config.output.lifetimes = true;
  return config;
}

struct Tried {
  size_t paths = 0, ended = 0;  // checked; gone after a motion that was longer than the lifetime
};

// Moves both ends by some of the lifetimes of the paths, in many directions: pair k of ends is for motion k.
Tried move_ends(uint32_t seed, const Features& features) {
  Random random(seed);
  const SceneFile file({Part{town(random), features.transmission ? "brick" : "metal"}});
  const auto place = [&] { return glm::dvec3(random.between(-14, 14), random.between(-14, 14), random.between(1, 9)); };
  const glm::dvec3 from = place(), to = place();
  const Paths paths = run(town_config(file, {from}, {to}, features)).paths;
  REQUIRE(paths.lifetime_m.size() == paths.size());
  if (paths.size() == 0) return {};
  std::vector<double> moves;
  Points moved_from, moved_to;
  for (int k = 0; k < 24; ++k) {
    const double lifetime = std::min(paths.lifetime_m[random.below(static_cast<uint32_t>(paths.size()))], 5.0);
    moves.push_back((k % 4 == 3 ? 3 : 0.9999) * lifetime);
    const glm::dvec3 way = random.direction();
    moved_from.push_back(from + moves.back() * way);
    moved_to.push_back(to + moves.back() * (k % 3 == 0 ? way : k % 3 == 1 ? -way : random.direction()));
  }
  Config config = town_config(file, moved_from, moved_to, features);
  const Paths after = run(config).paths;
  Tried out;
  for (uint32_t k = 0; k < moves.size(); ++k) {
    const std::set<Touched> left = paths_of_link(after, k, k);
    for (size_t row = 0; row < paths.size(); ++row) {
      const bool stays = left.contains(touched(paths, row));
      if (moves[k] > paths.lifetime_m[row]) {
        out.ended += !stays;
        continue;
      }
      CAPTURE(seed);
      CAPTURE(k);
      CAPTURE(moves[k]);
      CAPTURE(paths.depth[row]);
      CHECK(stays);
      ++out.paths;
    }
  }
  return out;
}

void try_towns(uint32_t least, const Features& features) {
  const char* const asked = std::getenv("WAVETRACER_RANDOM_SCENES");
  const uint32_t count = asked ? static_cast<uint32_t>(std::atoi(asked)) : least;
  Tried all;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    const Tried tried = move_ends(seed, features);
    all.paths += tried.paths;
    all.ended += tried.ended;
  }
  MESSAGE(all.paths, " paths stayed, ", all.ended, " ended after longer motions");
  CHECK(all.paths > 20 * count);
  CHECK(all.ended > count);
}

}  // namespace

TEST_CASE("no reflected path ends while its ends move by less than its lifetime") { try_towns(8, {}); }

TEST_CASE("no diffracted path ends while its ends move by less than its lifetime") {
  try_towns(4, {.diffraction = true});
}

TEST_CASE("no path through walls ends while its ends move by less than its lifetime") {
  try_towns(5, {.transmission = true});
}

namespace {

// The largest distance by which an end or a corner of a body has moved.
double motion_m(const Simulation& simulation, const WorldState& a, const WorldState& b) {
  double out = 0;
  for (size_t i = 0; i < a.instances.size(); ++i)
    for (const glm::dvec3& p : simulation.models()[simulation.instances()[i].model].vertices)
      out = std::max(out, glm::distance(a.instances[i].position_m + a.instances[i].rotation * p,
                                        b.instances[i].position_m + b.instances[i].rotation * p));
  for (size_t i = 0; i < a.transmitters.size(); ++i)
    out = std::max(out, glm::distance(a.transmitters[i].position_m, b.transmitters[i].position_m));
  for (size_t i = 0; i < a.receivers.size(); ++i)
    out = std::max(out, glm::distance(a.receivers[i].position_m, b.receivers[i].position_m));
  return out;
}

}  // namespace

TEST_CASE("no path off vehicles that drive and turn ends while all move by less than its lifetime") {
  const SceneFile file(street());
  Config config = town_config(file, {{-31.3, 2.17, 4.1}}, {{27.1, 5.21, 1.9}}, {.diffraction = true});
  config.vehicle_types = vehicle_types();
  config.tracks = {
      {"a", "passenger", {{0, -20, -3, 0}, {1, -10, -2, 0}, {2, -3, 4, 0}}},
      {"b", "passenger", {{0, 30, 4, 0}, {1, 20, 3, 0}, {2, 12, -3, 0}}},
      {"lorry", "truck", {{0, 19, 8, 0}, {1, 11, 9, 0}, {2, 4, 6, 0}}},
  };
  config.time.step_s = 0.002;
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  config.trace.reuse = false;
  Simulation simulation(config);
  size_t checked = 0, off_vehicles = 0;
  for (const uint32_t start : {100u, 420u, 700u}) {
    const FrameResult before = simulation.run_frame(start);
    for (const uint32_t later : {1u, 2u, 4u, 8u, 16u, 32u, 64u}) {
      const FrameResult after = simulation.run_frame(start + later);
      const double motion = motion_m(simulation, before.world, after.world);
      for (size_t row = 0; row < before.paths.size(); ++row) {
        if (before.paths.lifetime_m[row] < motion) continue;
        CAPTURE(start);
        CAPTURE(later);
        CAPTURE(row);
        CHECK(paths_of_link(after.paths, before.paths.tx[row], before.paths.rx[row])
                  .contains(touched(before.paths, row)));
        ++checked;
        off_vehicles += by_vehicle(before.paths, row);
      }
    }
  }
  MESSAGE(checked, " paths, ", off_vehicles, " off vehicles");
  CHECK(checked > 300);
  CHECK(off_vehicles > 20);
}
