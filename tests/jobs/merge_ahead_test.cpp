// SPDX-License-Identifier: Apache-2.0
// A merge that began before the last shard was there, against one that did not: the same bytes from every state.
#include "jobs/merge_ahead.hpp"
#include <doctest/doctest.h>
#include <chrono>
#include <fstream>
#include <thread>
#include "jobs/sample_parts.hpp"
#include "jobs/shards.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::names;
using test::slurp;
using test::TemporaryFolder;
using test::with_waypoints;

namespace {

// Frames 3 to 6002, so that some columns have full chunks, in five units.
constexpr uint32_t last_frame = 6002;
constexpr size_t full_chunks = 7;
const RunIdentity long_identity = sample_identity(last_frame);
const Units cut_units(3, last_frame, 1500);

void write_unit(Shards& shards, const SampleRun& sample, uint64_t index) {
  const Unit unit = cut_units.at(index);
  shards.write(sample.run(), sample.drive(unit.first, static_cast<uint32_t>(unit.frames())));
}

void wait_for_chunks(const MergeAhead& ahead, size_t wanted) {
  for (int i = 0; i < 3000 && ahead.chunks() < wanted; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

// The bytes of paths.h5, waypoints.h5 and links.csv.
std::vector<std::string> bytes_of(const std::vector<fs::path>& files) {
  return {slurp(files.at(0)), slurp(files.at(1)), slurp(files.at(2))};
}

std::vector<std::string> without(const SampleRun& sample) {
  const TemporaryFolder folder;
  Shards shards(folder.path(), long_identity);
  for (uint64_t i = 0; i < cut_units.count(); ++i) write_unit(shards, sample, i);
  return bytes_of(shards.merge(sample.run(), {}));
}

}  // namespace

TEST_CASE("a merge that follows shards as they finish writes what one at the end writes") {
  const SampleRun sample = with_waypoints();
  const std::vector<std::string> expected = without(sample);
  REQUIRE(cut_units.count() == 5);
  // It looks at this many units, so that the merge itself handles the last parts.
  for (const uint64_t looked : {0, 2, 5}) {
    CAPTURE(looked);
    const TemporaryFolder folder;
    Shards shards(folder.path(), long_identity);
    MergeAhead ahead(sample.config, cut_units, folder.path());
    for (uint64_t i = 0; i < cut_units.count(); ++i) {
      write_unit(shards, sample, i);
      if (i < looked) ahead.look();
    }
    if (looked == cut_units.count()) wait_for_chunks(ahead, full_chunks);
    CHECK((ahead.chunks() == full_chunks) == (looked == cut_units.count()));
    LinkStatistics links;
    const auto files = shards.merge(sample.run(), {}, &ahead, &links);
    CHECK(bytes_of(files) == expected);
    CHECK(links.asked == shards.totals().links);
    CHECK(names(folder.path()) ==
          std::vector<std::string>{"links.csv", "paths.h5", "shards", "summary.json", "waypoints.h5"});
  }
}

TEST_CASE(
    "units of several processes are taken in their order, whoever finishes first, and a torn line is waited for") {
  const SampleRun sample = with_waypoints();
  const TemporaryFolder folder;
  Shards one(folder.path(), long_identity), other(folder.path(), long_identity);
  one.share("one", true);
  other.share("other", true);
  MergeAhead ahead(sample.config, cut_units, folder.path());
  const auto files_of = [&](uint64_t index) {
    return folder.path() / "shards" / (unit_name(cut_units.at(index)) + ".h5");
  };
  const auto known = [&] {  // each call of of() ends it, so each question has an object of its own
    MergeAhead asked(sample.config, cut_units, folder.path());
    asked.look();
    std::vector<fs::path> parts;
    for (uint64_t i = 0; i < cut_units.count(); ++i) parts.push_back(files_of(i));
    const OutputAhead* const paths = asked.of(0, parts);
    return paths ? paths->parts.parts().size() : 0;
  };
  write_unit(other, sample, 1);
  write_unit(other, sample, 3);
  ahead.look();
  CHECK(known() == 0);
  write_unit(one, sample, 0);
  ahead.look();
  CHECK(known() == 2);
  const fs::path manifest = folder.path() / "shards" / "manifest.one.jsonl";
  write_unit(one, sample, 2);
  const std::string whole = slurp(manifest);
  std::ofstream(manifest, std::ios::binary) << whole.substr(0, whole.size() - 20);
  ahead.look();
  CHECK(known() == 2);
  std::ofstream(manifest, std::ios::binary) << whole;
  ahead.look();
  CHECK(known() == 4);
  write_unit(other, sample, 4);
  ahead.look();
  wait_for_chunks(ahead, full_chunks);
  CHECK(ahead.chunks() == full_chunks);
  one.look();
  CHECK(bytes_of(one.merge(sample.run(), {}, &ahead)) == without(sample));
}

TEST_CASE("a run that was killed while it merged ahead leaves shards alone, and is resumed with a merge of its own") {
  const SampleRun sample = with_waypoints();
  const TemporaryFolder folder;
  {
    Shards shards(folder.path(), long_identity);
    MergeAhead ahead(sample.config, cut_units, folder.path());
    for (uint64_t i = 0; i < 3; ++i) {
      write_unit(shards, sample, i);
      ahead.look();
    }
    CHECK(names(folder.path()) == std::vector<std::string>{"shards"});
  }
  Shards again(folder.path(), long_identity);
  CHECK(again.resume() == 3);
  MergeAhead ahead(sample.config, cut_units, folder.path());
  for (uint64_t i = 3; i < cut_units.count(); ++i) {
    write_unit(again, sample, i);
    ahead.look();
  }
  wait_for_chunks(ahead, full_chunks);
  CHECK(bytes_of(again.merge(sample.run(), {}, &ahead)) == without(sample));
}

TEST_CASE("what was merged ahead of other parts is not used, and a part that is damaged is named by the merge") {
  const SampleRun sample = with_waypoints();
  const TemporaryFolder folder;
  Shards shards(folder.path(), long_identity);
  MergeAhead ahead(sample.config, cut_units, folder.path()), damaged(sample.config, cut_units, folder.path());
  for (uint64_t i = 0; i < cut_units.count(); ++i) write_unit(shards, sample, i);
  ahead.look();
  const fs::path part = folder.path() / "shards" / (unit_name(cut_units.at(1)) + ".h5");
  CHECK(ahead.of(0, std::vector<fs::path>{part}) == nullptr);
  CHECK(ahead.of(7, std::vector<fs::path>{part}) == nullptr);
  fs::resize_file(part, 1000);
  damaged.look();
  CHECK_THROWS_WITH_AS(shards.merge(sample.run(), {}, &damaged), doctest::Contains((part.string() + ": ").c_str()),
                       InputError);
}
