// SPDX-License-Identifier: Apache-2.0
// The part of summary.json about a ray cache: sums over frames, whether they were written at once, in shards or
// resumed. The counts of a frame are invented: frame n has (k + 1) n of the k-th.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include "jobs/shards.hpp"
#include "output/cache_json.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;
using Json = nlohmann::json;

namespace {

// Frames first to last of a drive with a cache. Even frames reach depth 2 only.
std::vector<FrameResult> cached_drive(const SampleRun& sample, uint32_t first, uint32_t last) {
  std::vector<FrameResult> frames = sample.drive(first, last - first + 1);
  for (FrameResult& frame : frames) {
    const uint64_t n = frame.frame;
    frame.cache = {.on = true,
                   .lookups = n,
                   .hits = 2 * n,
                   .traced = 3 * n,
                   .groups = 4 * n,
                   .shared = 5 * n,
                   .conflicts = 6 * n,
                   .stale = 7 * n,
                   .stored = 8 * n,
                   .replaced = 9 * n,
                   .duplicates = 10 * n,
                   .dropped = 11 * n,
                   .exhausted = 12 * n,
                   .evicted = 13 * n,
                   .linked = 14 * n,
                   .entries = 4096,
                   .used = 100 + n,
                   .bytes = 300000,
                   .lookups_per_depth = {10 * n, n},
                   .hits_per_depth = {n, 0},
                   .shared_per_depth = {2 * n, 0},
                   .entries_by_hits = {n, 5, 1}};
    if (n % 2 == 0) continue;
    frame.cache.lookups_per_depth.push_back(1);
    frame.cache.hits_per_depth.push_back(1);
    frame.cache.shared_per_depth.push_back(2);
  }
  return frames;
}

Json summary_of(const std::vector<std::filesystem::path>& written) { return Json::parse(slurp(written[2])); }

SampleRun cached_run() {
  SampleRun sample;
  sample.config.cache.kind = "open";
  sample.config.cache.key = "exact";
  return sample;
}

// Frames 3 to 12: the numbers add up to 75, those of the five odd ones have a third depth.
void check_summary(const Json& cache) {
  CAPTURE(cache.dump());
  CHECK(cache["kind"] == "open");
  CHECK(cache["key"] == "exact");
  CHECK(cache["hit_rate"] == 2.0);
  const std::vector<std::string> counts = {"lookups",   "hits",      "traced",  "groups",   "shared",
                                           "conflicts", "stale",     "stored",  "replaced", "duplicates",
                                           "dropped",   "exhausted", "evicted", "linked"};
  for (size_t k = 0; k < counts.size(); ++k) {
    CAPTURE(counts[k]);
    CHECK(cache[counts[k]] == 75 * (k + 1));
  }
  CHECK(cache["entries"] == 4096);
  CHECK(cache["used"] == 112);
  CHECK(cache["bytes"] == 300000);
  CHECK(cache["lookups_per_depth"] == std::vector<int>{750, 75, 5});
  CHECK(cache["hits_per_depth"] == std::vector<int>{75, 0, 5});
  CHECK(cache["shared_per_depth"] == std::vector<int>{150, 0, 10});
  CHECK(cache["entries_by_hits"] == std::vector<int>{12, 5, 1});
}

}  // namespace

TEST_CASE("rays that the cache answered, or another ray of the frame, do not count as traced") {
  const TemporaryFolder folder;
  const SampleRun sample = cached_run();
  std::vector<FrameResult> frames = sample.frames();  // 5000 segments, 1 s of tracing
  frames[0].cache.on = frames[1].cache.on = true;
  frames[1].cache.lookups = 2000;
  frames[1].cache.hits = 1100;
  frames[1].cache.shared = 400;
  const Json summary = summary_of(write_outputs(folder.path(), sample.run(), frames));
  CHECK(summary["rays_per_second"] == 3500.0);
  CHECK(summary["counts"]["segments"] == 5000);
}

TEST_CASE("counts of the cache are sums, its table is that of the last frame") {
  const TemporaryFolder folder;
  const SampleRun sample = cached_run();
  check_summary(summary_of(write_outputs(folder.path(), sample.run(), cached_drive(sample, 3, 12)))["cache"]);
}

TEST_CASE("shards of an interrupted drive bring the counts of their caches along") {
  const TemporaryFolder folder;
  const SampleRun sample = cached_run();
  {
    Shards killed(folder.path(), sample_identity(12));
    killed.write(sample.run(), cached_drive(sample, 3, 6));
    killed.write(sample.run(), cached_drive(sample, 7, 9));
  }
  Shards again(folder.path(), sample_identity(12));
  REQUIRE(again.resume() == 2);
  const Json summary = summary_of(merge_interrupted(again, sample.run(), cached_drive(sample, 10, 12)));
  check_summary(summary["cache"]);
  CHECK(summary["counts"]["receptions"] == 30);
}

TEST_CASE("a cache that was never asked has no hit rate, and no cache has nothing but its kind") {
  const TemporaryFolder folder;
  SampleRun sample = cached_run();
  std::vector<FrameResult> frames = sample.frames();
  for (FrameResult& frame : frames) frame.cache.on = true;
  const Json unasked = summary_of(write_outputs(folder.path() / "unasked", sample.run(), frames))["cache"];
  CHECK(unasked["hit_rate"].is_null());
  CHECK(unasked["lookups"] == 0);
  sample.config.cache.kind = "none";
  const Json none = summary_of(write_outputs(folder.path() / "none", sample.run(), sample.frames()))["cache"];
  CHECK(none == Json{{"kind", "none"}});
  Shards shards(folder.path() / "drive", sample_identity(12));
  shards.write(sample.run(), sample.drive(3, 10));
  CHECK(slurp(folder.path() / "drive" / "shards" / "manifest.jsonl").find("cache") == std::string::npos);
  CHECK(Shards(folder.path() / "drive", sample_identity(12)).resume() == 1);
}

TEST_CASE("counts of a cache that are no whole numbers are refused with their names") {
  CacheSummary cache;
  cache.lookups_per_depth = {3};
  const nlohmann::ordered_json good = encode_cache(cache);
  CHECK(decode_cache(good).lookups_per_depth == cache.lookups_per_depth);
  for (const char* key : {"hits", "bytes", "lookups_per_depth"})
    for (const double number : {1e122, -1.0, 0.5}) {
      nlohmann::ordered_json bad = good;
      (bad[key].is_array() ? bad[key][0] : bad[key]) = number;
      const std::string message = std::string("\"") + key + "\" is ";
      CHECK_THROWS_WITH_AS(decode_cache(bad), doctest::Contains(message.c_str()), Json::type_error);
    }
}
