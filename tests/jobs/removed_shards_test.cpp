// SPDX-License-Identifier: Apache-2.0
// Shards are removed once the outputs were proved to contain them, and not before; a later run knows that the run is
// complete.
#include <doctest/doctest.h>
#include <fstream>
#include "jobs/earlier_run.hpp"
#include "jobs/merge_folders.hpp"
#include "jobs/merged_record.hpp"
#include "jobs/sample_parts.hpp"
#include "jobs/shards.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::identity;
using test::names;
using test::slurp;
using test::TemporaryFolder;

namespace {

Run asked(const SampleRun& sample) {
  Run run = sample.run();
  run.summary.frames_asked = 22;
  return run;
}

// The drive of frames 3 to 24 in two shards, merged.
std::vector<fs::path> write_without_shards(const fs::path& folder, const SampleRun& sample) {
  Shards shards(folder, identity);
  shards.write(asked(sample), sample.drive(3, 10));
  shards.write(asked(sample), sample.drive(13, 12));
  const auto files = shards.merge(asked(sample), {});
  shards.remove_merged();
  return files;
}

const std::vector<std::string> what_stays{"merged.json", "run.json"};

}  // namespace

TEST_CASE("shards go once all frames are merged, stay while one is missing, and stay where they are to be kept") {
  const TemporaryFolder folder, keeping;
  SampleRun sample;
  Shards shards(folder.path(), identity);
  shards.write(asked(sample), sample.drive(3, 10));
  shards.merge(asked(sample), {});
  shards.remove_merged();
  CHECK(fs::exists(folder.path() / "shards" / "manifest.jsonl"));
  CHECK_FALSE(fs::exists(merged_record(folder.path())));
  shards.write(asked(sample), sample.drive(13, 12));
  const auto files = shards.merge(asked(sample), {});
  CHECK(names(folder.path() / "shards").size() == 6 + 1);  // two shards, manifest, run.json, merged.json
  shards.remove_merged();
  CHECK(names(folder.path() / "shards") == what_stays);
  CHECK(test::Reader(files[0]).shape("/frames/frame")[0] == 22);
  sample.config.output.keep_shards = true;
  const auto kept = write_without_shards(keeping.path(), sample);
  CHECK(names(keeping.path() / "shards").size() == 6);
  CHECK(slurp(kept[0]) == slurp(files[0]));
}

TEST_CASE("a run that is resumed after its shards went is complete, and tells what it has") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const auto files = write_without_shards(folder.path(), sample);
  Shards again(folder.path(), identity);
  CHECK(again.resume() == 0);
  CHECK(again.complete());
  CHECK(again.finished({3, 12, 0, 1}));
  CHECK(again.outputs() == files);
  const Totals totals = again.totals();
  CHECK(totals.frames == 22);
  CHECK(totals.counts.paths == test::Reader(files[0]).shape("/paths/delay_s")[0]);

  RunIdentity other = identity;
  other.repeat = 2;
  CHECK_THROWS_WITH_AS(Shards(folder.path(), other).resume(), doctest::Contains("--repeat 1, this run has 2"),
                       ConfigError);
  CHECK_THROWS_WITH_AS(find_parts({folder.path()}), doctest::Contains("nothing is left to merge"), InputError);
}

TEST_CASE("a run that was killed between its record and the removal is complete, and the removal is done then") {
  const TemporaryFolder folder;
  const SampleRun sample;
  Shards shards(folder.path(), identity);
  shards.write(asked(sample), sample.drive(3, 22));
  shards.merge(asked(sample), {});
  REQUIRE(fs::exists(folder.path() / "shards" / "manifest.jsonl"));
  Shards again(folder.path(), identity);
  again.resume();
  CHECK(again.complete());
  CHECK(names(folder.path() / "shards") == what_stays);
}

TEST_CASE("a record whose outputs are gone, cut short or replaced makes no run complete") {
  const SampleRun sample;
  const auto complete_after = [&](auto change) {
    const TemporaryFolder folder;
    change(write_without_shards(folder.path(), sample), folder.path());
    Shards again(folder.path(), identity);
    again.resume();
    return again.complete();
  };
  CHECK(complete_after([](const auto&, const auto&) {}));
  CHECK_FALSE(complete_after([](const auto& files, const auto&) { fs::remove(files[1]); }));
  CHECK_FALSE(complete_after([](const auto& files, const auto&) { fs::resize_file(files[0], 1000); }));
  CHECK_FALSE(
      complete_after([](const auto& files, const auto&) { test::change_byte(files[0], fs::file_size(files[0]) / 2); }));
  CHECK_FALSE(
      complete_after([](const auto&, const auto& folder) { std::ofstream(merged_record(folder)) << "{\"first\":3"; }));
  CHECK_FALSE(complete_after([&](const auto&, const auto& folder) {  // outputs of another run, even with equal lengths
    write_outputs(folder, sample.run(), sample.drive(3, 22));
  }));
  CHECK_FALSE(complete_after(
      [&](const auto&, const auto& folder) { Shards(folder, identity).write(sample.run(), sample.drive(3, 5)); }));
}

TEST_CASE("shards whose rows are not in the manifest's number are kept") {
  const TemporaryFolder folder;
  const SampleRun sample;
  Shards shards(folder.path(), identity);
  shards.write(asked(sample), sample.drive(3, 22));
  // The file of another cut replaces this one, with the same length for the manifest.
  const TemporaryFolder other;
  const auto fewer = write_outputs(other.path(), sample.run(), sample.drive(3, 21));
  const fs::path part = folder.path() / "shards" / "frames_000003_000024.h5";
  fs::copy_file(fewer[0], part, fs::copy_options::overwrite_existing);
  CHECK_THROWS_WITH_AS(shards.merge(asked(sample), {}), doctest::Contains("the shards are kept"), RuntimeError);
  shards.remove_merged();
  CHECK(fs::exists(part));
  CHECK_FALSE(fs::exists(merged_record(folder.path())));
}
