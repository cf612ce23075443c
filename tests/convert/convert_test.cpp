// SPDX-License-Identifier: Apache-2.0
// The exporters called from C++: their results, warnings and errors; and their small helpers. It leaves the invented
// runs in the build folder, for the scripts that read the formats.
#include "convert/convert.hpp"
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include "base/pending_folder.hpp"
#include "base/unicode.hpp"
#include "folders.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/output.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

fs::path runs() { return fs::path(test::build_folder()) / "tests" / "convert"; }

fs::path write_run(const fs::path& folder, const SampleRun& sample, const std::vector<FrameResult>& frames) {
  write_outputs(folder, sample.run(), frames);
  return folder;
}

const Exporter& exporter(const std::string& name) {
  for (const Exporter& e : exporters())
    if (name == e.name) return e;
  throw RuntimeError("no exporter " + name);
}

bool mentions(const std::vector<std::string>& warnings, const std::string& text) {
  for (const std::string& warning : warnings)
    if (warning.find(text) != std::string::npos) return true;
  return false;
}

size_t entries(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("runs for the scripts") {
  const SampleRun sample;
  fs::create_directories(runs());
  write_run(runs() / "sample", sample, sample.drive(5, 12));
  CHECK(SavedRun(runs() / "sample").frame_count() == 12);
}

TEST_CASE("every format writes a run with two ports, a run without paths, and one frame") {
  const SampleRun sample;
  const test::TemporaryFolder folder;
  const SavedRun drive(write_run(folder.path() / "drive", sample, sample.frames()));
  const SavedRun empty(write_run(folder.path() / "empty", sample, sample.empty()));
  for (const char* name : {"sionna", "deepmimo", "ns3", "matlab"}) {
    CAPTURE(name);
    std::vector<std::string> warnings;
    const std::string stem = name;
    for (const auto& [run, last, suffix] :
         {std::tuple{&drive, size_t{1}, "_a"}, {&drive, size_t{0}, "_b"}, {&empty, size_t{0}, "_c"}}) {
      const Written written = exporter(name).write(*run, {folder.path() / (stem + suffix), 0, last, ""}, warnings);
      CHECK(written.front() == folder.path() / (stem + suffix));
      CHECK(fs::exists(written.front()));
    }
    const bool one_polarisation = stem == "deepmimo" || stem == "ns3";
    CHECK(mentions(warnings, "polarisation") == one_polarisation);
  }
}

TEST_CASE("times since 1970: steps are even but for rounding, and dates are those of the clock") {
  const SampleRun sample;
  const test::TemporaryFolder folder;
  std::vector<FrameResult> frames = sample.drive(0, 5);
  for (size_t k = 0; k < frames.size(); ++k) frames[k].world.time_s = 1.7e9 + 0.1 * static_cast<double>(k);
  const SavedRun run(write_run(folder.path() / "run", sample, frames));
  std::vector<std::string> warnings;
  exporter("ns3").write(run, {folder.path() / "ns3", 0, 4, ""}, warnings);
  CHECK_FALSE(mentions(warnings, "steps are of equal length"));
  const auto text_of = [](const fs::path& file) {
    std::ostringstream out;
    out << std::ifstream(file).rdbuf();
    return out.str();
  };
  CHECK(text_of(folder.path() / "ns3/Input/paraCfgCurrent.txt").find("totalTimeDuration\t0.5\n") != std::string::npos);
  ExportOptions kml{folder.path() / "run.kml", 0, 4, "+proj=tmerc +lat_0=48.14 +lon_0=11.57 +ellps=WGS84 +units=m"};
  exporter("kml").write(run, kml, warnings);
  CHECK(text_of(kml.output).find("<begin>2023-11-14T22:13:20.400Z</begin><end>2023-11-14T22:13:20.500Z</end>") !=
        std::string::npos);
}

TEST_CASE("padded arrays beyond some gigabytes are refused before they are made") {
  SampleRun sample;
  sample.config.transmitters.resize(8000);
  sample.config.receivers.resize(8000);
  const test::TemporaryFolder folder;
  std::vector<FrameResult> frames = sample.frames();
  const SavedRun run(write_run(folder.path() / "run", sample, frames));
  std::vector<std::string> warnings;
  CHECK_THROWS_WITH_AS(exporter("sionna").write(run, {folder.path() / "out.npz", 0, 1, ""}, warnings),
                       doctest::Contains("choose fewer frames with --frames"), InputError);
  CHECK(!fs::exists(folder.path() / "out.npz"));
}

TEST_CASE("a folder appears whole or not at all, and replaces nothing") {
  const test::TemporaryFolder folder;
  {
    PendingFolder pending(folder.path() / "new");
    pending.append("a/b.txt", "x");
    pending.append("a/b.txt", "y");
    CHECK(!fs::exists(folder.path() / "new"));
  }
  CHECK(entries(folder.path()) == 0);
  {
    PendingFolder pending(folder.path() / "new/");
    pending.append("a/b.txt", "x");
    pending.append("a/b.txt", "y");
    CHECK(pending.commit() == folder.path() / "new");
  }
  CHECK(entries(folder.path()) == 1);
  CHECK(fs::file_size(folder.path() / "new/a/b.txt") == 2);
  CHECK_THROWS_WITH_AS(PendingFolder(folder.path() / "new"), doctest::Contains("exists already"), InputError);
  fs::create_directory(folder.path() / "void");
  // Files may join those of a folder, once all are on the disk; a name that is there already is replaced.
  {
    PendingFolder pending(folder.path() / "new", PendingFolder::Earlier::kept);
    pending.append("more.txt", "more");
    pending.append("file.txt", "again");
    CHECK_FALSE(fs::exists(folder.path() / "new/more.txt"));
  }
  CHECK_FALSE(fs::exists(folder.path() / "new/more.txt"));
  {
    PendingFolder pending(folder.path() / "new", PendingFolder::Earlier::kept);
    pending.append("more.txt", "more");
    pending.commit();
  }
  CHECK(fs::file_size(folder.path() / "new/more.txt") == 4);
  {
    PendingFolder pending(folder.path() / "new", PendingFolder::Earlier::kept);
    pending.append("more.txt", "longer");
    pending.commit();
  }
  CHECK(fs::file_size(folder.path() / "new/more.txt") == 6);
  CHECK(fs::file_size(folder.path() / "new/a/b.txt") == 2);
  for (const auto& entry : fs::directory_iterator(folder.path())) CHECK_FALSE(entry.path().string().ends_with(".tmp"));
  PendingFolder(folder.path() / "void").commit();
  CHECK_THROWS_AS(PendingFolder(folder.path() / "no/parent"), RuntimeError);
}

TEST_CASE("names in other encodings") {
  CHECK(utf32("a\u00e9\u20ac\U0001F697") == U"a\u00e9\u20ac\U0001F697");
  CHECK(utf16("a\u00e9\u20ac\U0001F697") == u"a\u00e9\u20ac\U0001F697");
  // Cut short, a stray byte, overlong, a surrogate, above U+10FFFF.
  CHECK(utf32("\xE2\x82") == U"\uFFFD\uFFFD");
  CHECK(utf32("\x80z") == U"\uFFFDz");
  CHECK(utf32("\xC0\x80") == U"\uFFFD\uFFFD");
  CHECK(utf32("\xED\xA0\x80") == U"\uFFFD\uFFFD\uFFFD");
  CHECK(utf32("\xF4\x90\x80\x80") == U"\uFFFD\uFFFD\uFFFD\uFFFD");
  CHECK(utf32("").empty());
}
