// SPDX-License-Identifier: Apache-2.0
// SavedRun reads the lifetimes that write_outputs() writes.
#include <doctest/doctest.h>

#include "output/sample_run.hpp"
#include "results/saved_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;

TEST_CASE("lifetimes of paths are read back; a run that was not asked for them has none") {
  const test::TemporaryFolder folder;
  SampleRun sample;
  std::vector<FrameResult> frames = sample.frames();
  const fs::path without = write_outputs(folder.path() / "without", sample.run(), frames)[0];
  CHECK(SavedRun(without).frame(0).paths.lifetime_m.empty());
  sample.config.output.lifetimes = true;
  for (FrameResult& frame : frames)
    for (size_t row = 0; row < frame.paths.size(); ++row)
      frame.paths.lifetime_m.push_back(0.25 * static_cast<double>(row + frame.frame));
  const fs::path file = write_outputs(folder.path() / "with", sample.run(), frames)[0];
  for (size_t row = 0; row < frames.size(); ++row)
    CHECK(SavedRun(file).frame(row).paths.lifetime_m == frames[row].paths.lifetime_m);
  frames[0].paths.lifetime_m.pop_back();
  CHECK_THROWS_AS(write_outputs(folder.path() / "short", sample.run(), frames), RuntimeError);
}
