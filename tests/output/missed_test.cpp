// SPDX-License-Identifier: Apache-2.0
// The part of summary.json about missed paths: it is the same whether frames were written at once, in shards or in
// blocks. Counts of a frame are invented.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include "jobs/manifest.hpp"
#include "jobs/shards.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "output/totals.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;
using Json = nlohmann::json;

namespace {

std::vector<FrameResult> drive(const SampleRun& sample, uint32_t first, uint32_t last) {
  std::vector<FrameResult> frames = sample.drive(first, last - first + 1);
  for (FrameResult& frame : frames)
    frame.missed = {.frames = 1,
                    .paths = {frame.frame % 3, 4, 7, 100},
                    .powers = {1e-9 / frame.frame, 2e-9, 1e-8, 1e-7},
                    .amplitude = 3e-3,
                    .power = 3e-6 + 1e-8 * frame.frame};
  for (FrameResult& frame : frames)
    frame.certificate = {.frames = 1,
                         .depth = 5 - frame.frame % 2,
                         .edges = frame.frame == 5 ? 1u : 2u,
                         .any_depth = frame.frame != 7,
                         .ends = 2,
                         .left_out_sr = 0x1p-30 * frame.frame,
                         .left_out_power = 0x1p-40 * (frame.frame % 5),
                         .weak_sr = 0x1p-7,
                         .floor_db = -140};
  for (FrameResult& frame : frames)
    if (frame.frame % 2 == 0) frame.late = {1, frame.frame, 1e-9 * frame.frame, 2e-6, 5e-4 * frame.frame};
  return frames;
}

Json missed_of(const std::vector<std::filesystem::path>& written) {
  const Json summary = Json::parse(slurp(written[2]));
  return {{"missed", summary.at("missed")}, {"late", summary.at("late")}, {"certificate", summary.at("certificate")}};
}

}  // namespace

TEST_CASE("what was missed adds up over frames, at once and in the shards of an interrupted drive") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const Json both = missed_of(write_outputs(folder.path() / "whole", sample.run(), drive(sample, 3, 12)));
  const Json &whole = both["missed"], &late = both["late"];
  // f1 is 0, 1, 2, 0, 1, 2, ... in ten frames, f2 is 4 and f3 is 7 in each.
  const double estimate = 0.9 * 81 / 175 + 4.0 / 15 + 7.0 / 255;
  const double variance = 0.9 * 81 / 175 * 81 / 175 + 4.0 / 15 / 15 + 7.0 / 255 / 255;
  const double likeness = (0.375 * 0.9 * 175 / 81 + 5) / (4 + 5);
  CHECK(whole["paths"]["estimate"] == doctest::Approx(10 * likeness * estimate).epsilon(0.005));
  CHECK(whole["paths"]["low"] == 0);
  CHECK(whole["paths"]["high"] ==
        doctest::Approx(10 * (3 * likeness * (estimate + 1.96 * std::sqrt(variance)) + 3)).epsilon(0.005));
  // Frames 4, 6, 8, 10 and 12.
  CHECK(late["discoveries"] == 5);
  CHECK(late["paths"] == 40);
  CHECK(late["power_share"] == doctest::Approx(40e-9 / 10e-6));
  CHECK(late["largest_power_share"] == doctest::Approx(6e-3));
  // Frames 3 to 12 have two ends each, and the odd ones are complete to a smaller depth.
  CHECK(both["certificate"]["depth"] == 4);
  CHECK(both["certificate"]["left_out_sr"] == 75 * 0x1p-30);
  CHECK(both["certificate"]["left_out_share"] == doctest::Approx(75 * 0x1p-30 / (80 * 3.14159265358979)));
  CHECK(both["certificate"]["any_depth"] == false);
  CHECK(both["certificate"]["edges"] == 1);                     // the fewest of all frames
  CHECK(both["certificate"]["left_out_power"] == 4 * 0x1p-40);  // the largest of all frames
  CHECK(both["certificate"]["floor_db"] == -140);
  CHECK(both["certificate"]["weak_share"] == doctest::Approx(10 * 0x1p-7 / (80 * 3.14159265358979)));
  {
    Shards killed(folder.path(), sample_identity(12));
    killed.write(sample.run(), drive(sample, 3, 6));
    killed.write(sample.run(), drive(sample, 7, 9));
  }
  Shards again(folder.path(), sample_identity(12));
  REQUIRE(again.resume() == 2);
  again.write(sample.run(), drive(sample, 10, 12));
  CHECK(missed_of(again.merge(sample.run(), {})) == both);
}

TEST_CASE("blocks of a frame are one frame; where nothing is known, nothing is said") {
  const SampleRun sample;
  const std::vector<FrameResult> frames = drive(sample, 3, 4);
  Totals sum;
  for (int block = 0; block < 3; ++block) add_block(sum, totals_of({&frames[0], 1}));
  CHECK(sum.missed.frames == 1);
  CHECK(sum.missed.paths == std::array<uint64_t, 4>{0, 12, 21, 300});
  CHECK(sum.missed.powers[3] == doctest::Approx(3e-7));
  CHECK(sum.missed.amplitude == doctest::Approx(9e-3));
  CHECK(sum.certificate.frames == 1);
  CHECK(sum.certificate.ends == 6);
  CHECK(sum.certificate.left_out_sr == 9 * 0x1p-30);
  CHECK(sum.certificate.left_out_power == 3 * 0x1p-40);  // blocks have other links
  CHECK(sum.certificate.any_depth);
  add(sum, totals_of({&frames[1], 1}));
  CHECK(sum.certificate.frames == 2);
  CHECK(sum.missed.frames == 2);
  const TemporaryFolder folder;
  const auto written = write_outputs(folder.path(), sample.run(), sample.drive(3, 2));
  CHECK_FALSE(Json::parse(slurp(written[2])).contains("missed"));
  CHECK_FALSE(Json::parse(slurp(written[2])).contains("late"));
  CHECK_FALSE(Json::parse(slurp(written[2])).contains("certificate"));
}

TEST_CASE(
    "frames that do not know what was missed are counted, in shards too; an unknown block makes its frame unknown") {
  const SampleRun sample;
  std::vector<FrameResult> frames = drive(sample, 3, 12);
  for (const size_t i : {2, 8}) frames[i].missed = {.unknown = 1};
  const TemporaryFolder folder;
  const auto unknown_of = [](const std::filesystem::path& file) { return Json::parse(slurp(file)); };
  const Json whole = unknown_of(write_outputs(folder.path() / "whole", sample.run(), frames)[2]);
  CHECK(whole.at("missed_unknown").at("frames") == 2);
  CHECK(whole.at("missed_unknown").at("reason").get<std::string>().starts_with("the rays do not show it"));
  CHECK(whole.contains("missed"));
  Shards shards(folder.path(), sample_identity(12));
  shards.write(sample.run(), Frames(frames).first(4));
  shards.write(sample.run(), Frames(frames).subspan(4));
  const Json merged = unknown_of(shards.merge(sample.run(), {})[2]);
  CHECK(merged.at("missed_unknown") == whole.at("missed_unknown"));
  CHECK(merged.at("missed") == whole.at("missed"));

  Totals sum;
  for (const size_t i : {0, 2, 0}) add_block(sum, totals_of({&frames[i], 1}));
  CHECK(sum.missed.frames == 0);
  CHECK(sum.missed.unknown == 1);
  CHECK(sum.missed.power == 0);
  const Json none = unknown_of(write_outputs(folder.path() / "none", sample.run(), drive(sample, 3, 4))[2]);
  CHECK_FALSE(none.contains("missed_unknown"));
}

TEST_CASE("a manifest that names other quarters of a launch than four is refused, and says which line") {
  const TemporaryFolder folder;
  const SampleRun sample;
  Shards shards(folder.path(), sample_identity(12));
  shards.write(sample.run(), drive(sample, 3, 6));
  shards.write(sample.run(), drive(sample, 7, 12));
  const std::string text = slurp(folder.path() / "shards" / "manifest.jsonl");
  const size_t end = text.find('\n');
  REQUIRE(decode_manifest(text, "m").size() == 2);
  for (const char* key : {"paths", "powers"})
    for (const size_t quarters : {3, 5}) {
      Json line = Json::parse(text.substr(0, end));
      line["missed"][key] = std::vector<int>(quarters, 1);
      CHECK_THROWS_WITH_AS(decode_manifest(line.dump() + text.substr(end), "m"), doctest::Contains("m:1: "),
                           RuntimeError);
    }
}
