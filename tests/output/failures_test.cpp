// SPDX-License-Identifier: Apache-2.0
// If outputs cannot be written, the error names the file and nothing partial is left behind.
// The file size limit of the process simulates a full disk: it fails writes in the same places.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <span>
#include "base/pending_file.hpp"
#include "contains.hpp"
#include "folders.hpp"
#include "output/sample_run.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/output.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;

namespace {

// An empty folder of the test's own, removed with everything in it.
struct Scratch {
  fs::path path = fs::path(test::build_folder()) / "tests" / "output" / "failures";
  Scratch() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Scratch() { fs::remove_all(path); }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(path)) result.push_back(entry.path().filename());
    std::sort(result.begin(), result.end());
    return result;
  }
};

// While it exists, files beyond this many bytes cannot be written.
struct SizeLimit {
  rlimit before{};
  void (*handler)(int);
  explicit SizeLimit(rlim_t bytes) : handler(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
};

// The message of the RuntimeError that writing throws; empty if it throws none.
std::string error_of(const fs::path& directory, const Run& run, const std::vector<FrameResult>& frames) {
  try {
    write_outputs(directory, run, frames);
  } catch (const RuntimeError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a disk that fills up leaves neither files nor the folder, wherever it happens") {
  const Scratch scratch;
  SampleRun sample;
  sample.config.output.waypoints = 2;
  const auto written = write_outputs(scratch.path / "whole", sample.run(), sample.frames());
  const uintmax_t largest = fs::file_size(written[0]);
  for (size_t i = 1; i < written.size(); ++i) REQUIRE(largest > fs::file_size(written[i]));
  fs::remove_all(scratch.path / "whole");
  int failures = 0;
  for (uintmax_t limit = 0; limit < largest; limit += 1 + largest / 50) {
    CAPTURE(limit);
    std::string message;
    {
      const SizeLimit full(limit);
      message = error_of(scratch.path / "a" / "b", sample.run(), sample.frames());
    }
    CHECK(contains(message, "cannot write " + (scratch.path / "a" / "b").string()));
    CHECK(contains(message, "File too large"));
    CHECK(contains(message, "-o"));
    CHECK(scratch.names().empty());
    ++failures;
  }
  CHECK(failures > 40);
  // The library still works after all of this.
  CHECK(error_of(scratch.path / "a" / "b", sample.run(), sample.frames()) == "");
  CHECK(scratch.names() == std::vector<std::string>{"a", "b", "links.csv", "paths.h5", "summary.json", "waypoints.h5"});
}

TEST_CASE("a failure keeps the results of an earlier run") {
  const Scratch scratch;
  const SampleRun sample;
  SampleRun earlier;
  earlier.config.output.waypoints = 2;
  const auto written = write_outputs(scratch.path, earlier.run(), sample.frames());
  const auto size = fs::file_size(written[0]);
  {
    const SizeLimit full(size / 2);
    CHECK(error_of(scratch.path, sample.run(), sample.frames()) != "");
  }
  CHECK(fs::file_size(written[0]) == size);
  CHECK(scratch.names() == std::vector<std::string>{"links.csv", "paths.h5", "summary.json", "waypoints.h5"});
}

TEST_CASE("a folder in place of a file is an error before anything appears") {
  const Scratch scratch;
  SampleRun sample;
  sample.config.output.waypoints = 2;
  for (const char* name : {"paths.h5", "waypoints.h5", "links.csv", "summary.json"}) {
    fs::create_directories(scratch.path / name);
    const std::string message = error_of(scratch.path, sample.run(), sample.frames());
    CHECK(contains(message, (scratch.path / name).string()));
    CHECK(contains(message, "Is a directory"));
    CHECK(scratch.names() == std::vector<std::string>{name});
    fs::remove(scratch.path / name);
  }
}

TEST_CASE("a file in place of the folder, or of one above it") {
  const Scratch scratch;
  const SampleRun sample;
  std::ofstream(scratch.path / "file") << "keep me";
  CHECK(contains(error_of(scratch.path / "file", sample.run(), sample.frames()), "it is not a folder"));
  CHECK(contains(error_of(scratch.path / "file" / "below", sample.run(), sample.frames()), "Not a directory"));
  CHECK(scratch.names() == std::vector<std::string>{"file"});
  CHECK(fs::file_size(scratch.path / "file") == 7);
}

TEST_CASE("a rename that fails takes back the files that were already renamed") {
  const Scratch scratch;
  const std::string text = "whole";
  std::vector<PendingFile> files;
  files.emplace_back(scratch.path / "first", std::as_bytes(std::span(text)));
  files.emplace_back(scratch.path / "second", std::as_bytes(std::span(text)));
  fs::create_directory(scratch.path / "second");  // it was created after the file was written beside it
  CHECK_THROWS_WITH_AS(commit_together(files), doctest::Contains("Is a directory"), RuntimeError);
  files.clear();
  CHECK(scratch.names() == std::vector<std::string>{"second"});
}

TEST_CASE("a trailing slash and dots in the folder's name, as mkdir -p takes them") {
  const Scratch scratch;
  const SampleRun sample;
  CHECK(error_of(scratch.path / "x" / ".." / "y" / "", sample.run(), sample.frames()) == "");
  CHECK(scratch.names() == std::vector<std::string>{"links.csv", "paths.h5", "summary.json", "x", "y"});
}

TEST_CASE("a folder that may not be made") {
  const SampleRun sample;
  // /proc refuses even root.
  const std::string message = error_of("/proc/wavetracer/out", sample.run(), sample.frames());
  CHECK(contains(message, "cannot create the folder /proc/wavetracer/out"));
  CHECK(contains(message, "-o"));
}

TEST_CASE("inconsistent results are refused, not written") {
  const Scratch scratch;
  SampleRun sample;
  sample.config.output.waypoints = 2;
  const auto message_of = [&](const auto& spoil) {
    std::vector<FrameResult> frames = sample.frames();
    spoil(frames);
    return error_of(scratch.path / "new", sample.run(), frames);
  };
  CHECK(contains(message_of([](auto& frames) { frames[1].paths.gain_db.pop_back(); }), "paths of frame 8"));
  CHECK(contains(message_of([](auto& frames) { frames[0].paths.rx[1] = 2; }), "paths of frame 7"));
  CHECK(contains(message_of([](auto& frames) { frames[0].world.receivers.pop_back(); }), "paths of frame 7"));
  CHECK(contains(message_of([](auto& frames) { frames[1].world.links[3].tx = 2; }), "paths of frame 8"));
  CHECK(contains(message_of([](auto& frames) { frames[1].world.instances.clear(); }), "paths of frame 8"));
  CHECK(contains(message_of([](auto& frames) { frames[1].waypoints.tx.push_back(0); }), "waypoints of frame 8"));
  CHECK(scratch.names().empty());
}
