// SPDX-License-Identifier: Apache-2.0
// Responses, beams, carriers and radars in shards: merged, they are those of a run that is written whole, byte by byte.
#include <doctest/doctest.h>
#include "jobs/merge_folders.hpp"
#include "jobs/sample_parts.hpp"
#include "output/reader.hpp"
#include "output/sample_elements.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;

TEST_CASE("responses, beams, carriers and radars of a drive merge into the files of a run that was written whole") {
  const TemporaryFolder folder;
  SampleRun sample;
  ask_for_elements(sample.config);
  const auto frames = [&](uint32_t first, uint32_t count) {
    std::vector<FrameResult> out = sample.drive(first, count);
    add_elements(sample.config, out);
    return out;
  };
  const auto whole = write_outputs(folder.path() / "whole", sample.run(), frames(3, 22));
  Shards shards(folder.path() / "drive", test::identity);
  for (const auto& [first, count] : test::cuts) shards.write(sample.run(), frames(first, count));
  const auto drive = shards.merge(sample.run(), {});
  // Merges as `wavetracer merge` does, from the folder alone.
  const auto merged = merge_found(find_parts({folder.path() / "drive"}), folder.path() / "merged", "");
  REQUIRE(whole.size() == 7);
  REQUIRE(drive.size() == 7);
  REQUIRE(merged.size() == 7);
  for (size_t i = 0; i < 6; ++i) {
    CAPTURE(whole[i].filename());
    const std::string bytes = slurp(whole[i]);
    CHECK(bytes.size() > 100);
    CHECK((slurp(drive[i]) == bytes));
    CHECK((slurp(merged[i]) == bytes));
  }
}
