// A drive that is written in shards reads as one that is written whole, whatever happened between its shards.
// Frames are made up; the program's own drives are tested in tests/app.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "output/shards.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::datasets;
using test::Reader;
using test::slurp;
using test::TemporaryFolder;

namespace {

const RunIdentity identity{"1.2.3", "0123", "cpu", 3, 24, 1};
const std::vector<std::pair<uint32_t, uint32_t>> cuts{{3, 7}, {10, 10}, {20, 5}};  // first, count

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

std::vector<std::string> names(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder)) out.push_back(entry.path().filename());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

TEST_CASE("shards merge into the files of a run that was written whole") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const auto whole = write_outputs(folder.path() / "whole", sample.run(), sample.drive(3, 22));
  const auto drive = write_drive(folder.path() / "drive", sample);
  const auto expected = datasets(whole[0]), found = datasets(drive[0]);
  REQUIRE(expected.size() == 48);
  for (const auto& [name, value] : expected) {
    CAPTURE(name);
    REQUIRE(found.contains(name));
    CHECK(found.at(name) == value);
  }
  CHECK(found.size() == expected.size());
  CHECK(slurp(drive[1]) == slurp(whole[1]));
  CHECK(slurp(drive[1]).size() > 1000);
  const Reader h5(drive[0]);
  CHECK(h5.attribute("/", "config") == sample.config.text);
  CHECK(h5.attribute("/paths", "description") == Reader(whole[0]).attribute("/paths", "description"));
  auto a = nlohmann::json::parse(slurp(whole[2])), b = nlohmann::json::parse(slurp(drive[2]));
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
                                                  "manifest.jsonl"});
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

TEST_CASE("a drive that is resumed ends as one that was not interrupted, from every state of its folder") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const auto expected = write_drive(folder.path() / "expected", sample);
  const fs::path drive = folder.path() / "drive", manifest = drive / "shards" / "manifest.jsonl";
  // What a run that was killed leaves: the shards before it, and one of these.
  const std::vector<std::function<void()>> states = {
      [] {},
      [&] { std::ofstream(drive / "shards" / "frames_000010_000019.h5.77.tmp") << "half"; },
      [&] { std::ofstream(drive / "shards" / "frames_000010_000019.h5") << "in place, not in the manifest"; },
      [&] { std::ofstream(manifest, std::ios::app) << R"({"first":10,"last":19,"star)"; },
      [&] { std::ofstream(manifest, std::ios::app) << std::string(100, '\0') << "\n"; },
      [&] { fs::resize_file(drive / "shards" / "frames_000003_000009.csv", 10); },
      [&] { fs::remove(drive / "shards" / "frames_000003_000009.h5"); },
      [&] { std::ofstream(drive / "paths.h5.77.tmp") << "half"; },
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
    CHECK(finished == (i == 5 || i == 6 || i == 8 ? 0 : 1));
    for (const auto& cut : cuts)
      if (!again.finished(cut.first)) write(again, sample, cut);
    const auto merged = again.merge(sample.run(), {});
    CHECK(datasets(merged[0]) == datasets(expected[0]));
    CHECK(slurp(merged[1]) == slurp(expected[1]));
    CHECK(lines(manifest) == 3);
    CHECK(names(drive) == std::vector<std::string>{"links.csv", "paths.h5", "shards", "summary.json"});
    CHECK(names(drive / "shards").size() == 7);
  }
}

TEST_CASE("a finished drive is merged again; the frames of an interrupted shard are merged, but not kept") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const auto expected = write_drive(folder.path(), sample);
  const auto before = datasets(expected[0]);
  fs::remove(expected[0]);
  Shards again(folder.path(), identity);
  CHECK(again.resume() == 3);
  CHECK(again.totals().frames == 22);
  CHECK(datasets(again.merge(sample.run(), {})[0]) == before);

  const TemporaryFolder other, whole;
  Shards part(other.path(), identity);
  write(part, sample, cuts[0]);
  const auto written = part.merge(sample.run(), sample.drive(10, 4));
  const auto until = write_outputs(whole.path(), sample.run(), sample.drive(3, 11));
  CHECK(datasets(written[0]) == datasets(until[0]));
  CHECK(slurp(written[1]) == slurp(until[1]));
  CHECK(names(other.path()) == std::vector<std::string>{"links.csv", "paths.h5", "shards", "summary.json"});
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
  const auto old = write_drive(folder.path(), sample);
  std::ofstream(folder.path() / "shards" / "notes.txt") << "mine";
  RunIdentity other = identity;
  other.config = "4567";
  Shards shards(folder.path(), other);
  CHECK(fs::exists(old[0]));
  CHECK(names(folder.path() / "shards").size() == 8);
  shards.write(sample.run(), sample.drive(20, 5));
  CHECK(names(folder.path()) == std::vector<std::string>{"shards"});
  CHECK(names(folder.path() / "shards") ==
        std::vector<std::string>{"frames_000020_000024.csv", "frames_000020_000024.h5", "manifest.jsonl", "notes.txt"});
  fs::remove(folder.path() / "shards" / "notes.txt");
  write_outputs(folder.path(), sample.run(), sample.frames());  // a run of one frame leaves no shards beside it
  CHECK(names(folder.path()) == std::vector<std::string>{"links.csv", "paths.h5", "summary.json"});
}

TEST_CASE("a disk that fills up while shards are written or merged leaves whole files only") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const auto expected = datasets(write_drive(folder.path() / "whole", sample)[0]);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  int failed_writes = 0, failed_merges = 0;
  const fs::path drive = folder.path() / "drive";
  for (rlim_t limit = 0; limit < 1600000; limit = limit < 60000 ? limit + 3000 : limit * 2) {
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
      CHECK(limit > 1000000);
      continue;
    }
    ++(merging ? failed_merges : failed_writes);
    CHECK(message.find("cannot write " + drive.string()) != std::string::npos);
    CHECK(message.find("File too large") != std::string::npos);
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      CHECK(entry.path().extension() != ".tmp");
    Shards again(drive, identity);
    again.resume();
    for (const auto& cut : cuts)
      if (!again.finished(cut.first)) write(again, sample, cut);
    CHECK(datasets(again.merge(sample.run(), {})[0]) == expected);
  }
  std::signal(SIGXFSZ, handler);
  CHECK(failed_writes > 3);
  CHECK(failed_merges > 3);
}
