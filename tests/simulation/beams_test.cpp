// SPDX-License-Identifier: Apache-2.0
// Frames whose sequences beams find (trace.discovery): no path of a large launch is missing, between vehicles, with
// every kind of interaction, and wherever the world lies. brute_force_test.cpp and closed_form_test.cpp compare them
// with truths.
#include <set>

#include "passes/triangles.hpp"
#include "scene/load.hpp"
#include "simulation/drive.hpp"
#include "simulation/feature_choice.hpp"
#include "simulation/world.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config by_beams(Config config) {
  config.trace.discovery = "beams";
  return config;
}

// Checks that beams find all paths that rays find, and others only if rays may have missed them.
void check_holds(const Paths& beams, const Paths& rays, size_t at_least) {
  CHECK(rays.size() >= at_least);
  CHECK(missing(rays, beams) == 0);
  CHECK(beams.size() <= rays.size() + 2 + rays.size() / 50);
  CHECK(duplicates(beams) == 0);
}

// A house of five faces, and one that leans on it.
std::vector<Quad> houses() {
  std::vector<Quad> out = reference::box_walls({4, 3, 0}, {12, 9, 6});
  const std::vector<Quad> second = reference::box_walls({12, 3, 0}, {17, 9, 4.5});
  out.insert(out.end(), second.begin(), second.end());
  out.push_back({{-40, -40, 0}, {90, 0, 0}, {0, 90, 0}});
  out.push_back({{-6, -12, 0}, {0, 40, 0}, {0, 0, 9}});
  return out;
}

const Points before{{1.3, -2.1, 1.7}, {-3.7, 14.9, 7.3}}, behind{{20.3, 1.1, 1.5}, {8.1, 15.7, 2.9}, {2.2, 6.6, 1.1}};

// The lengths of all paths by link, in micrometres.
std::multiset<std::tuple<uint32_t, uint32_t, int64_t>> lengths_by_link(const Paths& paths) {
  std::multiset<std::tuple<uint32_t, uint32_t, int64_t>> out;
  for (size_t i = 0; i < paths.size(); ++i)
    out.insert({paths.tx[i], paths.rx[i], std::llround(paths.delay_s[i] * speed_of_light * 1e6 / 4)});
  return out;
}

// Each side is cut into n parts.
std::vector<Quad> subdivided(const std::vector<Quad>& quads, int n) {
  std::vector<Quad> out;
  for (const Quad& q : quads)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        out.push_back({q.corner + q.u * (i / double(n)) + q.v * (j / double(n)), q.u / double(n), q.v / double(n)});
  return out;
}

}  // namespace

TEST_CASE("beams between vehicles: every frame has all paths of a large launch, those off vehicles too") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-31.3, 2.17, 4.1}}, {{27.1, 5.21, 1.9}, {-8.7, 9.4, 1.3}}, 2000000, 3);
  add_vehicles(config,
               {{"a", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 4},
                {"b", "passenger", {30.7, 3.9, 0}, {-11.3, 0.3, 0}, 0, 2.5},
                {"lorry", "truck", {19.6, 7.1, 0}, {-7.9, -0.7, 0}, 1, 4}},
               0.5);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  config.trace.reuse = false;
  Simulation rays(config), beams(by_beams(config));
  size_t by_vehicles = 0;
  for (const uint32_t frame : {0u, 3u, 7u}) {
    CAPTURE(frame);
    const FrameResult found = beams.run_frame(frame);
    check_holds(found.paths, rays.run_frame(frame).paths, 20);
    CHECK(found.certificate.frames == 1);
    by_vehicles += paths_by_vehicles(found.paths);
    CHECK(identical(found.paths, beams.run_frame(frame).paths));
  }
  CHECK(by_vehicles > 10);
}

TEST_CASE("beams with diffraction, transmission and scattering have all paths of a large launch") {
  const SceneFile file({Part{houses(), "concrete"}});
  Config config = config_of(file.path(), before, behind, 1000000, 3);
  for (const auto& [diffraction, transmission] : {std::pair{true, false}, {false, true}, {true, true}}) {
    CAPTURE(diffraction);
    CAPTURE(transmission);
    config.trace.diffraction = diffraction;
    config.trace.transmission = transmission;
    check_holds(run(by_beams(config)).paths, run(config).paths, 20);
  }
}

TEST_CASE("beams: the same paths wherever the world lies, however it is turned and cut") {
  const std::vector<Quad> quads = houses();
  const auto paths_of = [](const std::vector<Quad>& all, const Points& from, const Points& to) {
    const SceneFile file(all);
    return run(by_beams(config_of(file.path(), from, to, 1000, 4))).paths;
  };
  const auto whole = lengths_by_link(paths_of(quads, before, behind));
  CHECK(whole.size() > 30);
  CHECK(lengths_by_link(paths_of(subdivided(quads, 4), before, behind)) == whole);
  // About the vertical, by an angle of which nothing is a multiple, and far from the origin.
  const double c = std::cos(0.7371), s = std::sin(0.7371);
  const auto turn = [&](const glm::dvec3& p) { return glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z); };
  const glm::dvec3 far{691000, 5335000, 500};
  std::vector<Quad> moved;
  for (const Quad& q : quads) moved.push_back({turn(q.corner) + far, turn(q.u), turn(q.v)});
  Points from = before, to = behind;
  for (Points* const points : {&from, &to})
    for (glm::dvec3& p : *points) p = turn(p) + far;
  CHECK(lengths_by_link(paths_of(moved, from, to)) == whole);
}

TEST_CASE("beams from antennas on a roof, a wall and the ground have all paths of a large launch") {
  const SceneFile file(houses());
  const Config config =
      config_of(file.path(), {{8.3, 5.1, 6}, {3.99999, 5, 2}, {-2.3, 0.7, 0.00005}}, behind, 2000000, 3);
  check_holds(run(by_beams(config)).paths, run(config).paths, 20);
}

TEST_CASE("beams to a depth of none: the direct paths alone") {
  const SceneFile file(houses());
  Config config = by_beams(config_of(file.path(), before, behind, 1000, 0));
  const FrameResult direct = run(config);
  CHECK(direct.certificate.depth == 0);
  CHECK(direct.certificate.left_out_sr == 0);
  for (const uint32_t depth : direct.paths.depth) CHECK(depth == 0);
}

TEST_CASE("discovery \"auto\" takes beams for one frame of a small scene at rest, and else rays with a reason") {
  const SceneFile file(houses());
  Config config = config_of(file.path(), before, behind, 20000, 3);
  config.trace.discovery = "auto";
  const auto reason = [](const Config& other) { return Simulation(other).features().at("beams").reason; };
  Simulation by_choice(config);
  const FrameResult found = by_choice.run_frame(0);
  CHECK(by_choice.features().at("beams").on);
  CHECK(found.certificate.frames == 1);
  CHECK(found.counts.rays == 0);
  CHECK(identical(found.paths, run(by_beams(config)).paths));
  config.trace.diffraction = true;  // from both ends
  CHECK(run(config).certificate.edges == 1);
  config.trace.diffraction = false;
  config.trace.discovery = "rays";
  CHECK(reason(config) == "trace.discovery = \"rays\"");

  config.trace.discovery = "auto";
  Config deep = config, passing = config, with_rays = config, drive = config;
  deep.trace.max_depth = auto_beam_depth + 1;
  passing.trace.transmission = true;
  with_rays.output.waypoints = 3;
  add_vehicles(drive, {{"a", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 1}}, 0.5);
  CHECK(reason(deep) == "trace.max_depth = 7 is more than 6");
  CHECK(reason(passing) == "beams through walls take longer (trace.transmission)");
  CHECK(reason(with_rays) == "output.waypoints = 3 writes rays of every frame");
  CHECK(reason(drive) == "bodies of vehicles are followed by rays");
  Scene scene = load_scene_file(file.path(), {});
  const World world = make_world(config, scene);
  CHECK(choose_features(config, scene, world, true).at("beams").reason ==
        "frames follow each other, and reuse what rays have found");
  scene.surfaces.resize(auto_beam_surfaces, scene.surfaces.front());
  CHECK(choose_features(config, scene, world).at("beams").on);
  scene.surfaces.push_back(scene.surfaces.front());
  CHECK(choose_features(config, scene, world).at("beams").reason == "4001 surfaces are more than 4000");
  const FrameResult rays = run(deep);
  CHECK(rays.certificate.frames == 0);
  CHECK(rays.counts.rays > 0);
}
