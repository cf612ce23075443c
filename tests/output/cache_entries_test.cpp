// SPDX-License-Identifier: Apache-2.0
// cache_entries.h5 as a reader finds it: every column of every frame in order, and no rows at all.
#include <doctest/doctest.h>
#include <cmath>
#include "output/cache_entries_h5.hpp"
#include "output/h5_outputs.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::Reader;

namespace {

using Numbers = std::vector<double>;

FrameResult with_entries(uint32_t frame) {
  FrameResult out;
  out.frame = frame;
  out.cache_entries = {.frame = {frame, frame},
                       .slot = {3, 70},
                       .region = {0, 1},
                       .depth = {1, 4},
                       .hits = {0, 9},
                       .age = {0, 4294967295u},
                       .length_m = {12.5, INFINITY},
                       .read_cycles = {0, 130},
                       .write_cycles = {156, 988}};
  return out;
}

fs::path entries_file(const fs::path& path, const Run& run, Frames frames) {
  hdf5::File head;
  encode_cache_entries_head_h5(run, head);
  FrameTables tables(path);
  for (const FrameResult& frame : frames) append_cache_entries_h5(run, frame, tables);
  tables.finish(head).commit();
  return path;
}

}  // namespace

TEST_CASE("cache_entries.h5 holds every column of every frame, in order") {
  const test::TemporaryFolder folder;
  const SampleRun sample;
  const std::vector<FrameResult> frames = {with_entries(7), FrameResult(), with_entries(9)};
  const Reader h5(entries_file(folder.path() / "cache_entries.h5", sample.run(), frames));
  CHECK(h5.numbers("/cache_entries/frame") == Numbers{7, 7, 9, 9});
  CHECK(h5.numbers("/cache_entries/slot") == Numbers{3, 70, 3, 70});
  CHECK(h5.numbers("/cache_entries/region") == Numbers{0, 1, 0, 1});
  CHECK(h5.numbers("/cache_entries/depth") == Numbers{1, 4, 1, 4});
  CHECK(h5.numbers("/cache_entries/hits") == Numbers{0, 9, 0, 9});
  CHECK(h5.numbers("/cache_entries/age") == Numbers{0, 4294967295.0, 0, 4294967295.0});
  CHECK(h5.numbers("/cache_entries/length_m") == Numbers{12.5, INFINITY, 12.5, INFINITY});
  CHECK(h5.numbers("/cache_entries/read_cycles") == Numbers{0, 130, 0, 130});
  CHECK(h5.numbers("/cache_entries/write_cycles") == Numbers{156, 988, 156, 988});
  CHECK(h5.attribute("/cache_entries/length_m", "units") == "m");
  CHECK(h5.attribute("/", "format") == "wavetracer cache entries");
}

TEST_CASE("columns of cache entries of unequal length are not written") {
  const SampleRun sample;
  FrameResult frame = with_entries(0);
  frame.cache_entries.age.pop_back();
  const test::TemporaryFolder folder;
  FrameTables tables(folder.path() / "cache_entries.h5");
  CHECK_THROWS_AS(append_cache_entries_h5(sample.run(), frame, tables), RuntimeError);
}

TEST_CASE("a run writes the HDF5 files that its configuration asks for") {
  const auto names = [](uint64_t waypoints, bool entries) {
    Config config;
    config.output.waypoints = waypoints;
    config.output.cache_entries = entries;
    std::vector<std::string> out;
    for (const H5Output& output : h5_outputs(config)) out.emplace_back(output.name);
    return out;
  };
  using Names = std::vector<std::string>;
  CHECK(names(0, false) == Names{"paths.h5"});
  CHECK(names(5, false) == Names{"paths.h5", "waypoints.h5"});
  CHECK(names(0, true) == Names{"paths.h5", "cache_entries.h5"});
  CHECK(names(5, true) == Names{"paths.h5", "waypoints.h5", "cache_entries.h5"});
}
