// SPDX-License-Identifier: Apache-2.0
// Tests the rows of a ray cache's entries: against the counts of the frame, which other code keeps, and on trees whose
// shape is known. The scene is a street with a car.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// One transmitter and one receiver in a street; every entry of each frame is asked for.
Config counted(const SceneFile& file, CacheKind kind) {
  Config config = config_of(file.path(), {{-40, 2, 6}, {-20, 5, 6}}, {{40, 3, 1.5}}, 3000, 3);
  add_vehicles(config, {{"a", "passenger", {-30, 4, 0}, {12, 0, 0}, 0, 4}}, 0.5);
  config.trace.reuse = false;
  config.cache.kind = kind;
  config.cache.buffer_size = 65536;
  config.cache.statistics = true;
  config.output.cache_entries = true;
  return config;
}

std::vector<FrameResult> frames_of_cache(const Config& config, uint32_t count) {
  Simulation simulation(config);
  std::vector<FrameResult> out;
  for (uint32_t frame = 0; frame < count; ++frame) out.push_back(simulation.run_frame(frame));
  return out;
}

uint64_t sum(const std::vector<uint32_t>& values) { return std::accumulate(values.begin(), values.end(), uint64_t{0}); }

// Answers of entries in groups of 0, 1, 2, 3 to 4, 5 to 8, ..., counted from the rows.
std::vector<uint64_t> groups_of(const std::vector<uint32_t>& hits) {
  std::map<size_t, uint64_t> counts = {{0, 0}};
  for (const uint32_t n : hits) ++counts[n == 0 ? 0 : 1 + static_cast<size_t>(std::ceil(std::log2(n)))];
  std::vector<uint64_t> out(counts.rbegin()->first + 1);
  for (const auto& [group, count] : counts) out[group] = count;
  return out;
}

}  // namespace

TEST_CASE("rows are the entries that the frame counts, with all their answers") {
  const SceneFile file(street());
  for (const char* kind : {"chained", "open", "concurrent", "thesis", "thesis-chained"}) {
    CAPTURE(kind);
    const std::vector<FrameResult> frames = frames_of_cache(counted(file, CacheKind::named(kind)), 3);
    uint64_t answers = 0;
    for (const FrameResult& frame : frames) {
      const CacheEntryRows& rows = frame.cache_entries;
      answers += frame.cache.hits;
      REQUIRE(rows.size() > 100);
      CHECK(sum(rows.hits) == answers);
      if (kind == std::string("thesis-chained")) {
        CHECK(rows.size() <= frame.cache.used);  // two writers at once may fill one root, and both are counted
      } else {
        CHECK(rows.size() == frame.cache.used);
        CHECK(groups_of(rows.hits) == frame.cache.entries_by_hits);
      }
      CHECK(std::ranges::all_of(rows.frame, [&](uint32_t number) { return number == frame.frame; }));
      CHECK(std::ranges::is_sorted(rows.slot));
      CHECK(std::set(rows.slot.begin(), rows.slot.end()).size() == rows.size());
      CHECK(rows.slot.back() < frame.cache.entries);
      // Two regions of one half each.
      for (size_t i = 0; i < rows.size(); ++i)
        CHECK(rows.region[i] == (rows.slot[i] < frame.cache.entries / 2 ? 0u : 1u));
      CHECK(std::ranges::max(rows.age) == frame.frame);  // some entries of the first frame are still there
      CHECK(static_cast<uint64_t>(std::ranges::count(rows.age, 0u)) <= frame.cache.stored);
    }
  }
}

TEST_CASE("an entry that never answered has no time of an answer, one that did has where there is a clock") {
  const SceneFile file(street());
  const std::vector<FrameResult> frames = frames_of_cache(counted(file, CacheKind("chained")), 2);
  const CacheEntryRows& rows = frames.back().cache_entries;
  const bool clock = std::ranges::max(rows.write_cycles) > 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    CHECK((rows.read_cycles[i] > 0) == (clock && rows.hits[i] > 0));
    CHECK((rows.write_cycles[i] > 0) == clock);
  }
}

TEST_CASE("depths: one bucket is one tree, many buckets hold most entries themselves") {
  const SceneFile file(street());
  Config config = counted(file, CacheKind("chained"));
  config.cache.load_factor = 65536;  // one bucket in each region
  std::map<uint32_t, std::map<uint32_t, uint64_t>> by_depth;
  const std::vector<FrameResult> one = frames_of_cache(config, 1);
  const CacheEntryRows& rows = one.front().cache_entries;
  for (size_t i = 0; i < rows.size(); ++i) ++by_depth[rows.region[i]][rows.depth[i]];
  for (const auto& [region, counts] : by_depth) {
    CAPTURE(region);
    CHECK(counts.at(1) == 1);  // the root
    uint64_t above = 1;
    for (const auto& [depth, count] : counts) {
      if (depth <= 1) continue;
      CHECK(count <= 2 * above);  // a tree of two links
      CHECK(counts.contains(depth - 1));
      above = count;
    }
    CHECK(counts.rbegin()->first > 10);  // there are hundreds of entries
  }
  config.cache.load_factor = 1;
  const std::vector<FrameResult> many = frames_of_cache(config, 1);
  const std::vector<uint32_t>& depths = many.front().cache_entries.depth;
  CHECK(2 * static_cast<size_t>(std::ranges::count(depths, 1u)) > depths.size());
  CHECK(std::ranges::count(depths, 0u) <= 2);
}

TEST_CASE("without the key a frame has no rows") {
  const SceneFile file(street());
  Config config = counted(file, CacheKind("open"));
  config.output.cache_entries = false;
  CHECK(frames_of_cache(config, 1).front().cache_entries.size() == 0);
}
