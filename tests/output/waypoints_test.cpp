// SPDX-License-Identifier: Apache-2.0
// waypoints.h5 as a reader finds it: every column of every frame in order, frames without waypoints, no frame at all.
#include <doctest/doctest.h>
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "output/waypoints_h5.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::Reader;

namespace {

using Values = std::vector<double>;
using Shape = std::vector<hsize_t>;

fs::path written(const fs::path& path, const Run& run, Frames frames) {
  hdf5::File head;
  encode_waypoints_head_h5(run, head);
  FrameTables tables(path);
  for (const FrameResult& frame : frames) append_waypoints_h5(run, frame, tables);
  tables.finish(head).commit();
  return path;
}

}  // namespace

TEST_CASE("waypoints.h5 holds every column of every frame, in order") {
  const test::TemporaryFolder folder;
  const SampleRun sample;
  std::vector<FrameResult> frames(3);
  frames[0].waypoints = sample_waypoints(7);
  frames[2].waypoints = sample_waypoints(9);
  const Reader h5(written(folder.path() / "waypoints.h5", sample.run(), frames));
  constexpr double none = 4294967295.0;
  CHECK(h5.numbers("/waypoints/frame") == Values{7, 7, 7, 7, 9, 9, 9, 9});
  CHECK(h5.numbers("/waypoints/tx") == Values{0, 0, 0, 1, 0, 0, 0, 1});
  CHECK(h5.numbers("/waypoints/sample") == Values{5, 5, 5, 0x1p40, 5, 5, 5, 0x1p40});
  CHECK(h5.numbers("/waypoints/depth") == Values{0, 1, 2, 2, 0, 1, 2, 2});
  CHECK(h5.numbers("/waypoints/kind") == Values{0, 1, 3, 4, 0, 1, 3, 4});
  CHECK(h5.numbers("/waypoints/surface") == Values{none, 17, 1, none, none, 17, 1, none});
  CHECK(h5.numbers("/waypoints/instance") == Values{none, 1, none, none, none, 1, none, none});
  CHECK(h5.numbers("/waypoints/source") == Values{0, 2, 3, 1, 0, 2, 3, 1});
  CHECK(h5.shape("/waypoints/position_m") == Shape{8, 3});
  const Values position_m = h5.numbers("/waypoints/position_m");
  CHECK(Values(position_m.begin() + 18, position_m.begin() + 24) == Values{1e6 + 9, 0.5, -2, 1e6 + 9, 0.75, -3});
  CHECK(h5.attribute("/waypoints/position_m", "units") == "m");
  CHECK(h5.attribute("/", "format") == "wavetracer waypoints");
  CHECK(h5.attribute("/", "config") == sample.config.text);
}

TEST_CASE("a run whose rays left no waypoints has empty columns") {
  const test::TemporaryFolder folder;
  const SampleRun sample;
  const Reader h5(written(folder.path() / "waypoints.h5", sample.run(), sample.empty()));
  CHECK(h5.shape("/waypoints/position_m") == Shape{0, 3});
  CHECK(h5.shape("/waypoints/kind") == Shape{0});
}

TEST_CASE("columns of unequal length are not written") {
  const SampleRun sample;
  std::vector<FrameResult> frames(1);
  frames[0].waypoints = sample_waypoints(0);
  frames[0].waypoints.instance.pop_back();
  const test::TemporaryFolder folder;
  FrameTables tables(folder.path() / "waypoints.h5");
  CHECK_THROWS_AS(append_waypoints_h5(sample.run(), frames[0], tables), RuntimeError);
}
