// SPDX-License-Identifier: Apache-2.0
// A drive that is written in shards reads as one that is written at once, whatever happened between its shards. Frames
// are invented; the program's own drives are tested in tests/app.
#include "jobs/shards.hpp"
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include "jobs/sample_parts.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::cuts;
using test::datasets;
using test::identity;
using test::names;
using test::Reader;
using test::slurp;
using test::TemporaryFolder;
using test::with_waypoints;

namespace {

void write(Shards& shards, const SampleRun& sample, std::pair<uint32_t, uint32_t> cut) {
  shards.write(sample.run(), sample.drive(cut.first, cut.second));
}

// Everything of the drive in a folder, written in one go.
std::vector<fs::path> write_drive(const fs::path& folder, const SampleRun& sample) {
  Shards shards(folder, identity);
  for (const auto& cut : cuts) write(shards, sample, cut);
  return shards.merge(sample.run(), {});
}

size_t lines(const fs::path& file) {
  const std::string text = slurp(file);
  return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("shards merge into the files of a run that was written whole") {
  const TemporaryFolder folder;
  SampleRun sample = with_waypoints();
  sample.config.output.cache_entries = true;
  const auto whole = write_outputs(folder.path() / "whole", sample.run(), sample.drive(3, 22));
  const auto drive = write_drive(folder.path() / "drive", sample);
  const std::vector<std::string> outputs{"paths.h5", "waypoints.h5", "cache_entries.h5", "links.csv", "summary.json"};
  REQUIRE(whole.size() == outputs.size());
  REQUIRE(drive.size() == outputs.size());
  for (size_t i = 0; i < outputs.size(); ++i) {
    CHECK(whole[i] == folder.path() / "whole" / outputs[i]);
    CHECK(drive[i] == folder.path() / "drive" / outputs[i]);
  }
  for (const auto& [file, columns] : {std::pair{size_t{0}, size_t{54}}, {1, 9}, {2, 9}}) {
    const auto expected = datasets(whole[file]), found = datasets(drive[file]);
    REQUIRE(expected.size() == columns);
    for (const auto& [name, value] : expected) {
      CAPTURE(name);
      REQUIRE(found.contains(name));
      CHECK(found.at(name) == value);
    }
    CHECK(found.size() == expected.size());
  }
  for (size_t i = 0; i < 4; ++i) {
    const bool same_bytes = slurp(drive[i]) == slurp(whole[i]);
    CAPTURE(outputs[i]);
    CHECK(same_bytes);
  }
  CHECK(slurp(drive[2]).size() > 1000);
  const Reader h5(drive[0]);
  CHECK(h5.attribute("/", "config") == sample.config.text);
  CHECK(h5.attribute("/paths", "description") == Reader(whole[0]).attribute("/paths", "description"));
  const Reader waypoints(drive[1]);
  CHECK(waypoints.attribute("/", "format") == "wavetracer waypoints");
  CHECK(waypoints.attribute("/", "config") == sample.config.text);
  CHECK(waypoints.attribute("/waypoints", "description") == Reader(whole[1]).attribute("/waypoints", "description"));
  std::vector<double> frames;  // frame n has n % 4 rows
  for (uint32_t frame = 3; frame < 25; ++frame) frames.insert(frames.end(), frame % 4, frame);
  CHECK(waypoints.numbers("/waypoints/frame") == frames);
  auto a = nlohmann::json::parse(slurp(whole.back())), b = nlohmann::json::parse(slurp(drive.back()));
  CHECK(b["shards"] == 3);
  CHECK(b["seconds"]["frame"] == doctest::Approx(0.5135));
  for (const char* key : {"counts", "frames", "first_frame", "last_frame", "links", "segments_per_depth", "warnings"})
    CHECK(a[key] == b[key]);
}

TEST_CASE("a shard is a paths.h5 and a links.csv of its own") {
  const TemporaryFolder folder;
  const SampleRun sample;
  write_drive(folder.path() / "drive", sample);
  const fs::path shards = folder.path() / "drive" / "shards";
  CHECK(names(shards) == std::vector<std::string>{"frames_000003_000009.csv", "frames_000003_000009.h5",
                                                  "frames_000010_000019.csv", "frames_000010_000019.h5",
                                                  "frames_000020_000024.csv", "frames_000020_000024.h5",
                                                  "manifest.jsonl", "run.json"});
  const auto alone = write_outputs(folder.path() / "alone", sample.run(), sample.drive(10, 10));
  CHECK(datasets(shards / "frames_000010_000019.h5") == datasets(alone[0]));
  CHECK(slurp(shards / "frames_000010_000019.csv") == slurp(alone[1]));
  const auto manifest = read_manifest(shards / "manifest.jsonl");
  REQUIRE(manifest.size() == 3);
  CHECK(manifest[1].run == identity);
  CHECK(manifest[1].totals.frames == 10);
  CHECK(manifest[1].totals.counts.segments == 25000);
  CHECK(manifest[1].totals.seconds.at("frame")[4] == 0.514);
  CHECK(manifest[1].totals.warnings == std::vector<std::string>{"a warning"});
}

TEST_CASE("with waypoints a shard has a third file, a waypoints.h5 of its own") {
  const TemporaryFolder folder;
  const SampleRun sample = with_waypoints();
  write_drive(folder.path() / "drive", sample);
  const fs::path shards = folder.path() / "drive" / "shards";
  CHECK(names(shards).size() == 3 * 3 + 2);
  const auto alone = write_outputs(folder.path() / "alone", sample.run(), sample.drive(10, 10));
  CHECK(datasets(shards / "frames_000010_000019.waypoints.h5") == datasets(alone[1]));
  CHECK(datasets(shards / "frames_000010_000019.h5") == datasets(alone[0]));
  const auto manifest = read_manifest(shards / "manifest.jsonl");
  REQUIRE(manifest.size() == 3);
  CHECK(manifest[1].files.size() == 3);
  for (const ShardFile& file : manifest[1].files) CHECK(file.bytes == fs::file_size(shards / file.name));
}

TEST_CASE("a drive that is resumed ends as one that was not interrupted, from every state of its folder") {
  const TemporaryFolder folder;
  const SampleRun sample = with_waypoints();
  const auto expected = write_drive(folder.path() / "expected", sample);
  const fs::path drive = folder.path() / "drive", manifest = drive / "shards" / "manifest.jsonl";
  // A killed run leaves the shards before the current one, and one of these states.
  const std::vector<std::function<void()>> states = {
      [] {},
      [&] { std::ofstream(drive / "shards" / "frames_000010_000019.h5.77.tmp") << "half"; },
      [&] { std::ofstream(drive / "shards" / "frames_000010_000019.h5") << "in place, not in the manifest"; },
      [&] { std::ofstream(manifest, std::ios::app) << R"({"first":10,"last":19,"star)"; },
      [&] { std::ofstream(manifest, std::ios::app) << std::string(100, '\0') << "\n"; },
      [&] { fs::resize_file(drive / "shards" / "frames_000003_000009.csv", 10); },
      [&] { fs::remove(drive / "shards" / "frames_000003_000009.h5"); },
      [&] { fs::remove(drive / "shards" / "frames_000003_000009.waypoints.h5"); },
      [&] { fs::resize_file(drive / "shards" / "frames_000003_000009.waypoints.h5", 1000); },
      [&] { std::ofstream(drive / "paths.h5.77.tmp") << "half"; },
      [&] { std::ofstream(drive / "waypoints.h5.77.tmp") << "half"; },
      [&] { std::ofstream(drive / "shards" / "frames_000010_000019.waypoints.h5.77.tmp") << "half"; },
      [&] { std::ofstream(drive / "shards" / "manifest.jsonl.77.tmp") << "half"; },
      [&] { fs::remove_all(drive); },
  };
  for (size_t i = 0; i < states.size(); ++i) {
    CAPTURE(i);
    fs::remove_all(drive);
    {
      Shards first(drive, identity);
      write(first, sample, cuts[0]);
    }
    states[i]();
    Shards again(drive, identity);
    const size_t finished = again.resume();
    CHECK(finished == ((i >= 5 && i <= 8) || i + 1 == states.size() ? 0 : 1));
    for (const auto& cut : cuts)
      if (!again.finished({cut.first})) write(again, sample, cut);
    const auto merged = again.merge(sample.run(), {});
    CHECK(datasets(merged[0]) == datasets(expected[0]));
    CHECK(datasets(merged[1]) == datasets(expected[1]));
    CHECK(slurp(merged[2]) == slurp(expected[2]));
    CHECK(lines(manifest) == 3);
    CHECK(names(drive) == std::vector<std::string>{"links.csv", "paths.h5", "shards", "summary.json", "waypoints.h5"});
    CHECK(names(drive / "shards").size() == 11);
  }
}

TEST_CASE("a finished drive is merged again; the frames of an interrupted shard are merged, but not kept") {
  const TemporaryFolder folder;
  const SampleRun sample = with_waypoints();
  const auto expected = write_drive(folder.path(), sample);
  const auto before = datasets(expected[0]), waypoints_before = datasets(expected[1]);
  fs::remove(expected[0]);
  fs::remove(expected[1]);
  Shards again(folder.path(), identity);
  CHECK(again.resume() == 3);
  CHECK(again.totals().frames == 22);
  const auto merged = again.merge(sample.run(), {});
  CHECK(datasets(merged[0]) == before);
  CHECK(datasets(merged[1]) == waypoints_before);

  const TemporaryFolder other, whole;
  Shards part(other.path(), identity);
  write(part, sample, cuts[0]);
  const auto written = merge_interrupted(part, sample.run(), sample.drive(10, 4));
  const auto until = write_outputs(whole.path(), sample.run(), sample.drive(3, 11));
  CHECK(datasets(written[0]) == datasets(until[0]));
  CHECK(datasets(written[1]) == datasets(until[1]));
  CHECK(slurp(written[2]) == slurp(until[2]));
  CHECK(names(other.path()) ==
        std::vector<std::string>{"links.csv", "paths.h5", "shards", "summary.json", "waypoints.h5"});
  CHECK(lines(other.path() / "shards" / "manifest.jsonl") == 1);
}

TEST_CASE("resuming another run is an error that says what differs, and touches nothing") {
  const TemporaryFolder folder;
  const SampleRun sample;
  write_drive(folder.path(), sample);
  const std::string manifest = slurp(folder.path() / "shards" / "manifest.jsonl");
  const auto check = [&](auto change, const char* message) {
    RunIdentity other = identity;
    change(other);
    CHECK_THROWS_WITH_AS(Shards(folder.path(), other).resume(), doctest::Contains(message), ConfigError);
  };
  check([](auto& run) { run.version = "1.2.4"; }, "written with version 1.2.3, this run has 1.2.4");
  check([](auto& run) { run.config = "4567"; }, "a configuration whose hash is 0123");
  check([](auto& run) { run.device_kind = "gpu"; }, "a device of kind cpu, this run has gpu");
  check([](auto& run) { run.last = 25; }, "--frames 3:24, this run has 3:25");
  check([](auto& run) { run.repeat = 2; }, "--repeat 1, this run has 2");
  RunIdentity rays = identity;
  rays.config = "4567";
  const auto named = [&](const std::string& config, const char* message) {
    CHECK_THROWS_WITH_AS(Shards(folder.path(), rays, {}, config).resume(), doctest::Contains(message), ConfigError);
  };
  named("[trace]\nrays = 7\n", "trace.rays was not given and is 7");
  named(sample.config.text, "a configuration whose hash is 0123");  // no key differs
  RunIdentity changed = identity;
  changed.inputs = "89ab";
  std::vector<InputFile> inputs = sample.run().summary.inputs;
  const auto refused_as = [&](const char* message) {
    CHECK_THROWS_WITH_AS(Shards(folder.path(), changed, inputs).resume(), doctest::Contains(message), InputError);
  };
  inputs[1].hash = 1;
  refused_as("/data/a.ply (scene.file: a.ply) has changed since the shards in ");
  inputs.pop_back();
  refused_as("/data/a.ply (scene.file: a.ply) is no longer read since");
  inputs[0].name = "trajectories.file";
  refused_as("/data/scene.xml (trajectories.file) is new since");
  CHECK(slurp(folder.path() / "shards" / "manifest.jsonl") == manifest);
}

TEST_CASE("a manifest that is damaged before its end is not guessed at") {
  const TemporaryFolder folder;
  write_drive(folder.path(), SampleRun());
  const fs::path manifest = folder.path() / "shards" / "manifest.jsonl";
  const std::string text = slurp(manifest);
  std::ofstream(manifest) << text.substr(0, 5) << text.substr(9);
  CHECK_THROWS_WITH_AS(Shards(folder.path(), identity).resume(), doctest::Contains("manifest.jsonl:1:"), RuntimeError);
}

TEST_CASE("another run replaces all of an earlier one with its first shard, and nothing before it") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const auto old = write_drive(folder.path(), with_waypoints());
  std::ofstream(folder.path() / "shards" / "notes.txt") << "mine";
  RunIdentity other = identity;
  other.config = "4567";
  Shards shards(folder.path(), other);
  CHECK(fs::exists(old[0]));
  CHECK(names(folder.path() / "shards").size() == 12);
  shards.write(sample.run(), sample.drive(20, 5));
  CHECK(names(folder.path()) == std::vector<std::string>{"shards"});
  CHECK(names(folder.path() / "shards") == std::vector<std::string>{"frames_000020_000024.csv",
                                                                    "frames_000020_000024.h5", "manifest.jsonl",
                                                                    "notes.txt", "run.json"});
  fs::remove(folder.path() / "shards" / "notes.txt");
  write_outputs(folder.path(), sample.run(), sample.frames());  // a run of one frame leaves no shards beside it
  CHECK(names(folder.path()) == std::vector<std::string>{"links.csv", "paths.h5", "summary.json"});
}

TEST_CASE("waypoints of an earlier run do not stay beside the paths of one that has none") {
  const SampleRun sample;
  const std::vector<std::string> without{"links.csv", "paths.h5", "summary.json"};
  const TemporaryFolder folder;
  write_outputs(folder.path(), with_waypoints().run(), sample.frames());
  CHECK(names(folder.path()) == std::vector<std::string>{"links.csv", "paths.h5", "summary.json", "waypoints.h5"});
  write_outputs(folder.path(), sample.run(), sample.frames());
  CHECK(names(folder.path()) == without);
  write_outputs(folder.path(), with_waypoints().run(), sample.frames());
  Shards first(folder.path(), identity);
  merge_interrupted(first, sample.run(), sample.drive(3, 2));
  CHECK(names(folder.path()) == without);
}

TEST_CASE("a disk that fills up while shards are written or merged leaves whole files only") {
  const TemporaryFolder folder;
  const SampleRun sample = with_waypoints();
  const auto whole = write_drive(folder.path() / "whole", sample);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  int failed_writes = 0, failed_merges = 0;
  const fs::path drive = folder.path() / "drive";
  // A shard needs some 340 kB with the reserved space, all of them merged some 350 kB.
  for (rlim_t limit = 0;; limit = limit < 330000 ? limit + 30000 : limit + 1500) {
    CAPTURE(limit);
    fs::remove_all(drive);
    const rlimit low{limit, before.rlim_max};
    Shards shards(drive, identity);
    setrlimit(RLIMIT_FSIZE, &low);
    std::string message;
    bool merging = false;
    try {
      for (const auto& cut : cuts) write(shards, sample, cut);
      merging = true;
      shards.merge(sample.run(), {});
    } catch (const RuntimeError& error) {
      message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    if (message.empty()) {
      CHECK(limit > 300000);
      break;
    }
    ++(merging ? failed_merges : failed_writes);
    CHECK(message.find("cannot write " + drive.string()) != std::string::npos);
    CHECK(message.find("File too large") != std::string::npos);
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) CHECK(entry.path().extension() != ".tmp");
    Shards again(drive, identity);
    again.resume();
    for (const auto& cut : cuts)
      if (!again.finished({cut.first})) write(again, sample, cut);
    const auto merged = again.merge(sample.run(), {});
    CHECK(datasets(merged[0]) == datasets(whole[0]));
    CHECK(datasets(merged[1]) == datasets(whole[1]));
  }
  std::signal(SIGXFSZ, handler);
  CHECK(failed_writes > 3);
  CHECK(failed_merges > 3);
}
