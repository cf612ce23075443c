// SPDX-License-Identifier: Apache-2.0
// SavedWaypoints reads what output.waypoints has written; damaged files are refused with a message, never trusted.
#include "results/saved_waypoints.hpp"
#include <doctest/doctest.h>
#include "output/sample_run.hpp"
#include "results/damage.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::overwrite;
using test::remove_member;

TEST_CASE("waypoints are read back frame by frame, and what is damaged is refused with words") {
  const test::TemporaryFolder folder;
  SampleRun sample;
  sample.config.output.waypoints = 2;
  const auto written = [&](const char* name) {
    return write_outputs(folder.path() / name, sample.run(), sample.drive(0, 4))[0].parent_path() / "waypoints.h5";
  };
  const fs::path whole = written("whole");
  const SavedWaypoints waypoints(whole);
  CHECK(waypoints.count() == 0 + 1 + 2 + 3);
  CHECK(waypoints.frame(0).size() == 0);
  CHECK(waypoints.frame(99).size() == 0);
  const WaypointRows rows = waypoints.frame(3), expected = sample_waypoints(3, 3);
  CHECK(rows.frame == expected.frame);
  CHECK(rows.tx == expected.tx);
  CHECK(rows.sample == expected.sample);
  CHECK(rows.depth == expected.depth);
  CHECK(rows.kind == expected.kind);
  CHECK(rows.position_m == expected.position_m);
  CHECK(rows.surface == expected.surface);
  CHECK(rows.instance == expected.instance);
  CHECK(rows.source == expected.source);
  CHECK(saved_waypoints(SavedRun(whole.parent_path())).has_value());
  fs::remove(whole);
  CHECK_FALSE(saved_waypoints(SavedRun(whole.parent_path())).has_value());

  const auto message = [](const fs::path& file) -> std::string {
    try {
      SavedWaypoints(file).frame(3);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const fs::path kind = written("kind"), gone = written("gone"), order = written("order");
  overwrite(kind, "/waypoints/kind", 5, uint8_t{9});
  CHECK(message(kind) == kind.string() + ": frame 3: /waypoints/kind has the number 9, which stands for nothing");
  remove_member(gone, "/waypoints/tx");
  const std::string refused = message(gone);
  CHECK(refused.find(gone.string() + ": cannot be read as the waypoints.h5 of a run: ") == 0);
  CHECK(refused.find("/waypoints/tx") != std::string::npos);
  overwrite(order, "/waypoints/frame", 0, uint32_t{3});
  CHECK(message(order).find("/waypoints/frame is not sorted") != std::string::npos);
  CHECK(message(kind.parent_path() / "paths.h5").find("its format is not \"wavetracer waypoints\"") !=
        std::string::npos);
}
