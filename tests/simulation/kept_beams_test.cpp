// SPDX-License-Identifier: Apache-2.0
// Beams of ends that stand are kept from frame to frame: a drive has the same paths and the same sequences as one whose
// frames follow all beams anew, and no path of a large launch of rays is missing.
#include <algorithm>

#include "gpu/call_error.hpp"
#include "passes/triangles.hpp"
#include "simulation/beam_tracing.hpp"
#include "simulation/drive.hpp"
#include "simulation/frame.hpp"
#include "simulation/setup.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A street with a road-side unit and a receiver that stand, two cars with antennas, a lorry that comes into the street
// while they go on, and one that stands.
Config drive(const SceneFile& file, uint32_t max_depth) {
  Config config = config_of(file.path(), {{-31.3, 2.17, 4.1}}, {{27.1, 5.21, 1.9}}, 1000000, max_depth);
  add_vehicles(config,
               {{"a", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 4},
                {"b", "passenger", {30.7, 3.9, 0}, {-11.3, 0.3, 0}, 0, 2.5},
                {"lorry", "truck", {19.6, 7.1, 0}, {-7.9, -0.7, 0}, 1, 4},
                {"parked", "truck", {2.1, -9.3, 0}, {1e-6, 0, 0}, 0, 4}},
               0.5);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  config.trace.discovery = "beams";
  return config;
}

Config anew(Config config) {
  config.trace.reuse = false;
  return config;
}

// Compares frames in this order with those of a drive that keeps nothing.
void check_same(const Config& config, const std::vector<uint32_t>& frames) {
  Simulation kept(config), fresh(anew(config));
  size_t by_vehicles = 0;
  for (const uint32_t frame : frames) {
    CAPTURE(frame);
    const FrameResult a = kept.run_frame(frame), b = fresh.run_frame(frame);
    CHECK(identical(a.paths, b.paths));
    CHECK(a.counts.sequences == b.counts.sequences);
    CHECK(a.certificate.left_out_sr == b.certificate.left_out_sr);
    CHECK(a.certificate.weak_sr == b.certificate.weak_sr);
    CHECK(a.certificate.any_depth == b.certificate.any_depth);
    CHECK(a.certificate.ends == b.certificate.ends);
    by_vehicles += paths_by_vehicles(a.paths);
  }
  CHECK(by_vehicles > 5);
}

}  // namespace

TEST_CASE("beams that are kept: each frame of a drive is that of beams that are followed anew") {
  const SceneFile file(street());
  check_same(drive(file, 3), {0, 1, 2, 5, 7, 3});
}

TEST_CASE("beams that are kept, with diffraction, with transmission, and down to a floor") {
  const SceneFile file(street());
  for (const bool diffraction : {true, false}) {
    CAPTURE(diffraction);
    Config config = drive(file, 2);
    config.trace.diffraction = diffraction;
    config.trace.transmission = !diffraction;
    check_same(config, {2, 3});
  }
  Config config = drive(file, 9);
  config.trace.floor_db = -85;
  check_same(config, {2, 3, 4});
}

TEST_CASE("beams that are kept: no path of a large launch is missing in a later frame") {
  const SceneFile file(street());
  const Config config = drive(file, 3);
  Config by_rays = anew(config);
  by_rays.trace.discovery = "rays";
  Simulation kept(config), rays(by_rays);
  for (const uint32_t frame : {0u, 2u, 5u}) {
    CAPTURE(frame);
    const Paths found = kept.run_frame(frame).paths, sampled = rays.run_frame(frame).paths;
    CHECK(paths_by_vehicles(sampled) > 3);
    CHECK(missing(sampled, found) == 0);
  }
}

TEST_CASE("beams that are kept serve batches of receivers and blocks of transmitters, after each other") {
  const SceneFile file(street());
  Config config = drive(file, 2);
  Simulation all(config);
  const Paths whole = all.run_frame(2).paths;
  CHECK(whole.size() > 20);
  config.trace.batch_receivers = 1;
  Simulation batched(config);
  for (int times = 0; times < 2; ++times) CHECK(identical(batched.run_frame(2).paths, whole));
  size_t in_blocks = 0;
  for (const uint32_t transmitter : {0u, 1u, 2u}) {
    const Paths block = all.run_block(2, {transmitter, transmitter + 1}).paths;
    in_blocks += block.size();
    CHECK(missing(block, whole) == 0);
  }
  CHECK(in_blocks == whole.size());
  CHECK(identical(all.run_frame(2).paths, whole));
}

TEST_CASE("beams that are kept go when a frame lacks memory, and the frame is computed without them") {
  const SceneFile file(street());
  Setup setup = make_setup(drive(file, 2), "");
  FrameLoop loop(setup);
  int lacking = 0, poses = 0;
  const auto frame = [&] {
    return loop.run(FrameTask::of_drive({.frame = 2,
                                         .pose =
                                             [&] {
                                               ++poses;
                                               if (lacking-- > 0) throw gpu::BufferError("no memory");
                                               return setup.plan->world.state(2);
                                             },
                                         .names = FrameNames::none()}));
  };
  const FrameResult before = frame();
  CHECK(before.paths.size() > 20);
  CHECK(setup.beams->kept_bytes() > 0);
  lacking = 1;
  poses = 0;
  const FrameResult without = frame();
  CHECK(poses == 2);
  CHECK(identical(without.paths, before.paths));
  const auto tells = [](const FrameResult& result) {
    return std::ranges::any_of(result.warnings,
                               [](const std::string& w) { return w.find("are dropped") != std::string::npos; });
  };
  CHECK(!tells(before));
  CHECK(tells(without));
  CHECK(setup.beams->kept_bytes() == 0);
  const FrameResult after = frame();
  CHECK(!tells(after));
  CHECK(identical(after.paths, before.paths));
  CHECK(setup.beams->kept_bytes() == 0);
  lacking = 1;  // nothing is left to drop
  CHECK_THROWS_AS(frame(), gpu::BufferError);
}

TEST_CASE("beams that are kept go when they do not fit, and the sequences stay the same") {
  const Scene scene = scene_of_triangles(room(Room::box, 1, 3));
  const DeviceScene device = make_device_scene(context(), scene, false);
  BeamOptions options{.mirrors = lossless_mirrors(scene.surfaces.size())};
  const BeamTask task{.standing = {{.transmitter = 0, .position_m = {0.31, -0.72, 0.93}}},
                      .moving = {{.transmitter = 1, .position_m = {-0.2, 0.1, 0.4}}},
                      .max_depth = 2,
                      .keep = true};
  const auto sequences = [&](BeamTracing& beams, size_t slots) {
    Sequences set(context(), slots);
    set.clear();
    beams.find(device, task, set);
    const std::vector<uint64_t> table = set.table().read();
    return std::ranges::count_if(table, [](uint64_t word) { return word != WT_EMPTY; });
  };
  BeamTracing beams(context(), scene, {}, options);
  beams.set_world({}, {});
  const auto count = sequences(beams, 1 << 14);
  CHECK(count > 50);
  const uint64_t bytes = beams.kept_bytes();
  CHECK(bytes == (1 << 14) * (sizeof(uint64_t) + sizeof(uint32_t)));
  CHECK(sequences(beams, 1 << 14) == count);  // from what is kept
  CHECK(sequences(beams, 1 << 13) == count);  // slots of another table are not these
  CHECK(beams.kept_bytes() == bytes / 2);
  CHECK(sequences(beams, 64) == count);  // it grows while beams are followed
  beams.forget();
  CHECK(beams.kept_bytes() == 0);
  options.most_kept_bytes = bytes - 1;
  BeamTracing narrow(context(), scene, {}, options);
  narrow.set_world({}, {});
  for (int times = 0; times < 2; ++times) CHECK(sequences(narrow, 1 << 14) == count);
  CHECK(narrow.kept_bytes() == 0);
}
