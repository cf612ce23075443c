// SPDX-License-Identifier: Apache-2.0
// Parts of a run in several folders make the outputs of the whole run, or an error that names what is wrong.
// Frames are made up; parts are cut by hand.
#include "jobs/merge_folders.hpp"
#include <doctest/doctest.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include "folders.hpp"
#include "jobs/run_record.hpp"
#include "jobs/sample_parts.hpp"
#include "jobs/shards.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::cuts;
using test::datasets;
using test::identity;
using test::note_as_written;
using test::slurp;
using test::TemporaryFolder;
using test::with_waypoints;

namespace {

void write_part(const fs::path& folder, const std::string& name, const std::vector<size_t>& units,
                const RunIdentity& run = identity) {
  const SampleRun sample = with_waypoints();
  Shards shards(folder, run);
  shards.share(name, true);
  for (const size_t unit : units) shards.write(sample.run(), sample.drive(cuts[unit].first, cuts[unit].second));
}

void check_same(const fs::path& found, const fs::path& expected) {
  for (const char* file : {"paths.h5", "waypoints.h5"}) {
    CHECK(datasets(found / file) == datasets(expected / file));
    const bool same_bytes = slurp(found / file) == slurp(expected / file);
    CHECK(same_bytes);
  }
  CHECK(slurp(found / "links.csv") == slurp(expected / "links.csv"));
  const auto a = nlohmann::json::parse(slurp(found / "summary.json")),
             b = nlohmann::json::parse(slurp(expected / "summary.json"));
  for (const auto& [key, value] : b.items()) {
    CAPTURE(key);
    if (key != "seconds" && key != "peak_memory_bytes" && key != "command_line" && key != "frames_asked" &&
        key != "shards")
      CHECK(a[key] == value);
  }
}

}  // namespace

TEST_CASE("parts in one folder or in many make the files of a run that was written whole") {
  const TemporaryFolder folder;
  const SampleRun sample = with_waypoints();
  write_outputs(folder.path() / "whole", sample.run(), sample.drive(3, 22));
  write_part(folder.path() / "a", "0_of_2", {2, 0});
  write_part(folder.path() / "b", "1_of_2", {1});
  const FoundParts apart = find_parts({folder.path() / "a", folder.path() / "b"});
  CHECK(apart.missing_count == 0);
  merge_found(apart, folder.path() / "out", "");
  check_same(folder.path() / "out", folder.path() / "whole");
  CHECK(test::Reader(folder.path() / "out/paths.h5").attribute("/", "config") == sample.config.text);

  write_part(folder.path() / "a", "1_of_2", {1});
  merge_found(find_parts({folder.path() / "a"}), folder.path() / "a", "");
  check_same(folder.path() / "a", folder.path() / "whole");
  CHECK(fs::exists(folder.path() / "a/shards/manifest.1_of_2.jsonl"));
  // Units that are there twice and agree count once.
  merge_found(find_parts({folder.path() / "b", folder.path() / "a"}), folder.path() / "twice", "");
  check_same(folder.path() / "twice", folder.path() / "whole");
}

TEST_CASE("what is missing is named, and what is there can be merged") {
  const TemporaryFolder folder;
  write_part(folder.path() / "a", "0_of_2", {0, 2});
  const FoundParts found = find_parts({folder.path() / "a"});
  REQUIRE(found.missing.size() == 1);
  CHECK(found.missing[0] == Unit{10, 19, 0, 1});
  merge_found(found, folder.path() / "out", "");
  const auto frames = test::Reader(folder.path() / "out/paths.h5").numbers("/frames/frame");
  CHECK(frames == std::vector<double>{3, 4, 5, 6, 7, 8, 9, 20, 21, 22, 23, 24});
  fs::resize_file(folder.path() / "a/shards/frames_000003_000009.h5", 100);
  const FoundParts damaged = find_parts({folder.path() / "a"});
  CHECK(damaged.missing.size() == 1);
  CHECK(damaged.missing[0] == Unit{3, 19, 0, 1});
  REQUIRE(damaged.damaged.size() == 1);
  CHECK(damaged.damaged[0].starts_with("frames 3 to 9 in "));
}

TEST_CASE("folders without parts, of different runs, or that contradict each other are refused") {
  const TemporaryFolder folder;
  const fs::path a = folder.path() / "a", b = folder.path() / "b";
  CHECK_THROWS_WITH_AS(find_parts({a}), doctest::Contains("contains no manifest"), InputError);
  write_part(a, "0_of_2", {0});
  RunIdentity other = identity;
  other.config = "4567";
  write_part(b, "1_of_2", {1}, other);
  CHECK_THROWS_WITH_AS(find_parts({a, b}),
                       doctest::Contains("different runs: different hashes of the configuration 0123 and 4567"),
                       InputError);
  fs::remove_all(b);
  write_part(b, "1_of_2", {0});
  const fs::path manifest = b / "shards/manifest.1_of_2.jsonl";
  Shard changed = read_manifest(manifest).at(0);
  changed.totals.links += 90;
  std::ofstream(manifest) << encode_manifest_line(changed);
  CHECK_THROWS_WITH_AS(find_parts({a, b}), doctest::Contains("differs from the same part elsewhere"), InputError);
}

TEST_CASE("a hostile part is an error that names it, and nothing is written") {
  const TemporaryFolder folder;
  const fs::path a = folder.path() / "a", shards = a / "shards", manifest = shards / "manifest.0_of_1.jsonl";
  write_part(a, "0_of_1", {0, 1, 2});
  const std::string text = slurp(manifest);
  const auto with = [&](const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    std::ofstream(manifest) << text.substr(0, at) << to << text.substr(at + from.size());
  };
  with("\"name\":\"frames_000003_000009.h5\"", "\"name\":\"../../../../etc/passwd\"");
  CHECK_THROWS_WITH_AS(find_parts({a}), doctest::Contains("does not belong to this shard"), RuntimeError);
  with("\"first\":3", "\"first\":-3");
  CHECK_THROWS_WITH_AS(find_parts({a}), doctest::Contains("manifest.0_of_1.jsonl:1:"), RuntimeError);
  with("\"last\":9", "\"last\":4000000000");
  CHECK_THROWS_AS(find_parts({a}), RuntimeError);
  std::ofstream(manifest) << text;

  // A part has the right length but other bytes: a file of zeros, then one of another run. The hash of the manifest
  // shows it; then the manifest is adapted, and the part is refused for other reasons.
  const fs::path part = shards / "frames_000010_000019.h5";
  const std::string bytes = slurp(part);
  std::ofstream(part, std::ios::binary) << std::string(bytes.size(), '\0');
  CHECK(find_parts({a}).damaged.size() == 1);
  note_as_written(manifest);
  CHECK_THROWS_WITH_AS(merge_found(find_parts({a}), folder.path() / "out", ""), doctest::Contains(part.c_str()),
                       InputError);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  const fs::path first = shards / "frames_000003_000009.h5";
  const std::string first_bytes = slurp(first);
  std::ofstream(first, std::ios::binary) << std::string(first_bytes.size(), '\0');
  note_as_written(manifest);
  CHECK_THROWS_WITH_AS(merge_found(find_parts({a}), folder.path() / "out", ""), doctest::Contains(first.c_str()),
                       InputError);
  std::ofstream(first, std::ios::binary) << first_bytes;
  // A part on which the library may crash (1.10.8 does): the second one, which the error must name.
  const std::string fault = slurp(fs::path(test::source_folder()) / "tests/fuzz/corpus/merge/fault_in_attribute.h5");
  std::ofstream(part, std::ios::binary) << fault;
  note_as_written(manifest);
  CHECK_THROWS_WITH_AS(merge_found(find_parts({a}), folder.path() / "out", ""), doctest::Contains(part.c_str()),
                       InputError);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  std::ofstream(manifest) << text;
  std::ofstream(part, std::ios::binary) << bytes;
  std::ofstream(shards / "run.json") << "{\"version\":1}";
  CHECK_THROWS_WITH_AS(merge_found(find_parts({a}), folder.path() / "out", ""), doctest::Contains("run.json"),
                       RuntimeError);
  for (const char* record : {"", "[]", "{}", "null", "{\"vehicles\":1e300}"})
    CHECK_THROWS_AS(decode_run_record(record, "run.json"), RuntimeError);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
}

TEST_CASE("a part that took the place of another is known by what it says of its run") {
  const TemporaryFolder folder;
  const fs::path a = folder.path() / "a", part = a / "shards/frames_000010_000019.h5";
  write_part(a, "0_of_1", {0, 1, 2});
  const auto put = [&](const auto& change) {
    SampleRun sample = with_waypoints();
    Run run = sample.run();
    change(sample.config, run.summary);
    Shards(folder.path() / "other", identity).write(run, sample.drive(10, 10));
    fs::copy_file(folder.path() / "other/shards/frames_000010_000019.h5", part, fs::copy_options::overwrite_existing);
    note_as_written(a / "shards/manifest.0_of_1.jsonl");
    return find_parts({a});
  };
  const fs::path out = folder.path() / "out";
  const FoundParts config = put([](Config& c, RunSummary&) { c.text.back() = ' '; });
  CHECK(config.damaged.empty());
  CHECK_THROWS_WITH_AS(merge_found(config, out, ""), doctest::Contains("another configuration"), InputError);
  const FoundParts scene = put([](Config&, RunSummary& summary) { summary.inputs[0].hash += 1; });
  CHECK(scene.damaged.empty());
  CHECK_THROWS_WITH_AS(merge_found(scene, out, ""), doctest::Contains("other input files"), InputError);
  const FoundParts same = put([](Config&, RunSummary&) {});
  CHECK_NOTHROW(merge_found(same, out, ""));
}

TEST_CASE("every manifest cut short or with a byte changed is read or refused") {
  const TemporaryFolder folder;
  write_part(folder.path() / "a", "0_of_1", {0, 1});
  const std::string text = slurp(folder.path() / "a/shards/manifest.0_of_1.jsonl");
  const std::string first = text.substr(0, text.find('\n') + 1);
  size_t read = 0, refused = 0;
  for (size_t at = 0; at < text.size(); at += 3) {
    for (const std::string& changed : {text.substr(0, at), text.substr(0, at) + "9" + text.substr(at + 1),
                                       text.substr(0, at) + text.substr(at + 1)}) {
      try {
        // Lines that are damaged are refused, or left out where they are the last.
        const std::vector<Shard> lines = decode_manifest(changed, "m");
        std::string again;
        for (const Shard& line : lines) again += encode_manifest_line(line);
        CHECK((again.empty() || again == first || again == text));
        ++read;
      } catch (const RuntimeError&) {
        ++refused;
      }
    }
  }
  CHECK(read > 100);
  CHECK(refused > 100);
}
