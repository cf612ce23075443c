// What summary.json says of missed paths: the same whether frames were written at once, in shards or in blocks.
// Counts of a frame are made up.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "output/shards.hpp"
#include "output/totals.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;
using Json = nlohmann::json;

namespace {

const RunIdentity identity{"1.2.3", "0123", "cpu", 3, 12, 1};

std::vector<FrameResult> drive(const SampleRun& sample, uint32_t first, uint32_t last) {
  std::vector<FrameResult> frames = sample.drive(first, last - first + 1);
  for (FrameResult& frame : frames)
    frame.missed = {.frames = 1,
                    .paths = {frame.frame % 3, 4, 7, 100},
                    .rare_power = 1e-9 / frame.frame,
                    .found_power = 1e-7,
                    .power = 3e-6 + 1e-8 * frame.frame};
  return frames;
}

Json missed_of(const std::vector<std::filesystem::path>& written) {
  return Json::parse(slurp(written[2])).at("missed");
}

}  // namespace

TEST_CASE("what was missed adds up over frames, at once and in the shards of an interrupted drive") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const Json whole = missed_of(write_outputs(folder.path() / "whole", sample.run(), drive(sample, 3, 12)));
  // f1 is 0, 1, 2, 0, 1, 2, ... in ten frames, and f2 is 4 in each.
  CHECK(whole["paths"]["estimate"] == doctest::Approx(10 * 0.5 * 0.9 * 0.9 / 5).epsilon(0.005));
  CHECK(whole["paths"]["low"] == 0);
  CHECK(whole["paths"]["high"] == 30);
  {
    Shards killed(folder.path(), identity);
    killed.write(sample.run(), drive(sample, 3, 6));
    killed.write(sample.run(), drive(sample, 7, 9));
  }
  Shards again(folder.path(), identity);
  REQUIRE(again.resume() == 2);
  again.write(sample.run(), drive(sample, 10, 12));
  CHECK(missed_of(again.merge(sample.run(), {})) == whole);
}

TEST_CASE("blocks of a frame are one frame; where nothing is known, nothing is said") {
  const SampleRun sample;
  const std::vector<FrameResult> frames = drive(sample, 3, 4);
  Totals sum;
  for (int block = 0; block < 3; ++block) add_block(sum, totals_of({&frames[0], 1}));
  CHECK(sum.missed.frames == 1);
  CHECK(sum.missed.paths == std::array<uint64_t, 4>{0, 12, 21, 300});
  add(sum, totals_of({&frames[1], 1}));
  CHECK(sum.missed.frames == 2);
  const TemporaryFolder folder;
  const auto written = write_outputs(folder.path(), sample.run(), sample.drive(3, 2));
  CHECK_FALSE(Json::parse(slurp(written[2])).contains("missed"));
}
