// SPDX-License-Identifier: Apache-2.0
// Tests antennas far outside of the scene: drones, platforms, satellites and sites beside it have the paths that many
// rays find; and where few rays meet anything, the program does not claim that nothing was missed.
#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const Points street{{60, -3, 1.5}, {8, 8, 1.5}, {-120, -3, 1.5}, {0, 150, 1.5}, {-8, -60, 1.5}, {100, -100, 1.5}};

Config seen_from(const glm::dvec3& p, std::optional<uint64_t> rays, Directions directions = "horizon") {
  Config config = config_of("", {p}, street, rays, 3);
  config.scene.generate = "--seed 1 --blocks 6x6";
  config.trace.directions = directions;
  return config;
}

size_t lost(const FrameResult& all, const Config& config) {
  const FrameResult found = run(config);
  CHECK(found.missed.frames == 1);
  CHECK(found.counts.hits > found.counts.rays / 2);  // nearly all meet the scene
  return missing(all.paths, found.paths);
}

bool says_few_met(const FrameResult& frame) {
  return std::ranges::any_of(frame.warnings, [](const std::string& text) {
    return text.starts_with("less than 2% of the rays met anything");
  });
}

}  // namespace

TEST_CASE("from above and from beside, at every distance, 10^4 to 10^5 rays and \"auto\" find what 10^6 find") {
  for (const glm::dvec3& p : {glm::dvec3(40, 30, 3000),
                              {40, 30, 20000},
                              {40, 30, 500000},
                              {9000, -4000, 6000},
                              {2400, 1800, 1200},
                              {-5e5, 2e5, 7e5}}) {
    CAPTURE(p.x);
    CAPTURE(p.z);
    const FrameResult all = run(seen_from(p, 1000000));
    CHECK(all.paths.size() >= 5);
    CHECK(lost(all, seen_from(p, 100000)) == 0);
    CHECK(lost(all, seen_from(p, std::nullopt)) == 0);
    CHECK(lost(all, seen_from(p, 30000, "hilbert")) == 0);
  }
  const glm::dvec3 platform{40, 30, 20000};
  const FrameResult all = run(seen_from(platform, 1000000));
  for (const Directions map : std::to_array<Directions>({"fibonacci", "random"})) {
    CAPTURE(map);
    CHECK(lost(all, seen_from(platform, 100000, map)) == 0);
  }
}

TEST_CASE("a platform above a drive: frames that reuse, listeners of diffraction, the link the other way") {
  Config config = seen_from({40, 30, 20000}, 100000);
  config.receivers.push_back({"uav", {-60, 20, 9000}});
  config.transmitters.push_back({"rsu", {10, -3, 5}});
  config.tracks = {{"a", "passenger", {{0, -60, -3.1, 0}, {3, -30, -3.1, 0}}}};
  config.time.step_s = 1;
  config.trace.diffraction = true;
  config.trace.max_depth = 2;
  Config more = config;
  more.trace.rays = 1000000;
  more.trace.diffraction_rays = 300000;
  more.trace.reuse = false;
  Simulation drive(config), truth(more);
  for (uint32_t frame = 0; frame < 3; ++frame) {
    CAPTURE(frame);
    const FrameResult found = drive.run_frame(frame), all = truth.run_frame(frame);
    CHECK(all.paths.size() > 100);
    CHECK(static_cast<double>(missing(all.paths, found.paths)) <= 0.03 * static_cast<double>(all.paths.size()));
  }
}

TEST_CASE("waypoints and a cache follow the rays of far antennas from the antenna on") {
  const glm::dvec3 platform{40, 30, 20000};
  const FrameResult all = run(seen_from(platform, 200000));
  Config followed = seen_from(platform, 100000);
  followed.output.waypoints = 50;
  const FrameResult trails = run(followed);
  CHECK(missing(all.paths, trails.paths) == 0);
  Config cached = seen_from(platform, 100000);
  cached.cache.kind = "open";
  cached.cache.key = "exact";
  CHECK(missing(all.paths, run(cached).paths) == 0);
}

TEST_CASE("where few rays meet anything there is no estimate of what was missed, but a warning") {
  // A mast of a kilometre beside a city: its box is around the antenna, and nearly all rays leave the world.
  const std::vector<Quad> quads{{{-5, -5, 0}, {10, 0, 0}, {0, 10, 0}},
                                {{0, 5, 0}, {2, 0, 0}, {0, 0, 3}},
                                {{9000, 0, 0}, {0.1, 0, 0}, {0, 0, 9000}}};
  const SceneFile file(quads);
  const FrameResult frame = run(config_of(file.path(), {{4500, 3, 4000}}, {{1, 1, 1}}, 20000, 2));
  CHECK(says_few_met(frame));
  CHECK(frame.missed.frames == 0);
  CHECK(frame.missed.unknown == 1);
  CHECK(frame.paths.quarters.empty());
  const FrameResult street_level = run(config_of(file.path(), {{1, 2, 2}}, {{1, 1, 1}}, 20000, 2));
  CHECK_FALSE(says_few_met(street_level));
  CHECK(street_level.missed.frames == 1);
}

TEST_CASE("a town on a wide plain, seen from far away: launches that lose paths do not say \"probably none\"") {
  // The plain is around every antenna, so no window helps: rays meet the plain, and hardly one of them meets the town.
  std::vector<Quad> quads{{{-50000, -50000, 0}, {100000, 0, 0}, {0, 100000, 0}}};
  for (int i = -2; i < 2; ++i)
    for (int k = -2; k < 2; ++k) {
      const glm::dvec3 at{50 * i + 10, 50 * k + 10, 0}, x{30 + 2 * i, 0, 0}, y{0, 30 - k, 0}, z{0, 0, 14 + i + 3 * k};
      quads.insert(quads.end(), {{at, x, z}, {at + y, x, z}, {at, y, z}, {at + x, y, z}, {at + z, x, y}});
    }
  const SceneFile file(quads);
  const Points streets{{5, 5, 1.5}, {-45, 20, 1.5}, {55, -60, 1.5}, {5, -80, 1.5}};
  for (const glm::dvec3& p : {glm::dvec3(12000, 7000, 8000), {3000, 1700, 2000}, {30000, 17000, 20000}}) {
    CAPTURE(p.x);
    Config config = config_of(file.path(), {p}, streets, 10000, 3);
    config.trace.discovery = "beams";
    const FrameResult all = run(config);
    CHECK(all.certificate.frames == 1);
    config.trace.discovery = "rays";
    for (const std::optional<uint64_t> rays : {std::optional<uint64_t>(10000), {200000}, {}}) {
      config.trace.rays = rays;
      const FrameResult found = run(config);
      CHECK(found.counts.hits > found.counts.rays / 50);  // those of the plain
      if (missing(all.paths, found.paths) == 0) continue;
      CHECK(found.missed.frames == 0);
      CHECK(found.missed.unknown == 1);
      CHECK(found.paths.quarters.empty());  // so links have no estimate either
      CHECK(std::ranges::any_of(found.warnings, [](const std::string& text) {
        return text.find("m and more apart where a receiver is") != std::string::npos;
      }));
    }
  }
  const FrameResult near = run(config_of(file.path(), {{10, 5, 20}}, streets, 10000, 3));
  CHECK(near.missed.frames == 1);
  CHECK(near.missed.unknown == 0);
  CHECK(near.paths.quarters.size() == near.paths.size());
}
