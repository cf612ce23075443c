// SPDX-License-Identifier: Apache-2.0
// The osi export read back as trajectories: the same vehicles at the same times and places.
#include <doctest/doctest.h>
#include <cmath>
#include <glm/geometric.hpp>
#include "convert/convert.hpp"
#include "motion/read.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/output.hpp"

using namespace wavetracer;

TEST_CASE("the traffic of a run, written as a trace of OSI and read again") {
  const SampleRun sample;
  const test::TemporaryFolder folder;
  write_outputs(folder.path() / "drive", sample.run(), sample.drive(5, 12));
  const SavedRun run(folder.path() / "drive");
  std::vector<std::string> warnings;
  const ExportOptions options{.output = folder.path() / "drive.osi", .last_row = run.frame_count() - 1};
  CHECK(export_osi(run, options, warnings).at(0) == options.output);
  const Trajectories back = read_trajectories(options.output);
  size_t samples = 0, poses = 0;
  for (size_t row = 0; row < run.frame_count(); ++row) {
    const SavedFrame frame = run.frame(row);
    poses += frame.poses.size();
    for (const SavedPose& pose : frame.poses) {
      const SavedInstance& vehicle = run.instances()[pose.instance];
      CAPTURE(vehicle.id);
      for (const Track& track : back.tracks) {
        if (track.id != vehicle.id) continue;
        CHECK(back.types[track.type].name == vehicle.type);
        for (const Sample& s : track.samples) {
          if (std::abs(s.time_s - frame.time_s) > 1e-9) continue;
          ++samples;
          CHECK(glm::distance(s.position_m, pose.position_m) < 1e-9);
          const glm::dvec3& ahead = pose.rotation[0];
          CHECK(std::cos(s.yaw_rad - std::atan2(ahead.y, ahead.x)) > 1 - 1e-12);
        }
      }
    }
  }
  CHECK(poses > 5);
  CHECK(samples == poses);
}

TEST_CASE("times since 1970, and far beyond what nanoseconds of 64 bits reach, come back") {
  const SampleRun sample;
  const test::TemporaryFolder folder;
  for (const double zero_s : {-1.5, 1.7e9, 1e11}) {
    std::vector<FrameResult> frames = sample.drive(5, 12);
    for (size_t k = 0; k < frames.size(); ++k) frames[k].world.time_s = zero_s + 0.1 * static_cast<double>(k);
    const std::filesystem::path drive = folder.path() / std::to_string(zero_s);
    write_outputs(drive, sample.run(), frames);
    const SavedRun run(drive);
    std::vector<std::string> warnings;
    const ExportOptions options{.output = drive / "drive.osi", .last_row = run.frame_count() - 1};
    export_osi(run, options, warnings);
    const Trajectories back = read_trajectories(options.output);
    CHECK(back.first_time_s >= zero_s);
    CHECK(back.last_time_s <= zero_s + 1.1 + 1e-4);
    CHECK(back.step_s == doctest::Approx(0.1));
    for (const Track& track : back.tracks)
      for (const Sample& s : track.samples) {
        const double steps = (s.time_s - zero_s) / 0.1;
        CHECK(std::abs(steps - std::round(steps)) < 1e-3);
      }
  }
}

TEST_CASE("a run without vehicles has no traffic to write") {
  SampleRun sample;
  sample.instances.clear();
  const test::TemporaryFolder folder;
  std::vector<FrameResult> frames = sample.empty();
  for (FrameResult& frame : frames) frame.world.instances.clear();
  write_outputs(folder.path() / "still", sample.run(), frames);
  std::vector<std::string> warnings;
  const SavedRun run(folder.path() / "still");
  CHECK_THROWS_WITH_AS(export_osi(run, {.output = folder.path() / "still.osi"}, warnings),
                       doctest::Contains("no vehicles with a body"), InputError);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "still.osi"));
}
