// SPDX-License-Identifier: Apache-2.0
// Bytes of shards that changed since they were written are noticed before anything is merged.
// Frames are invented; the bytes are changed by hand.
#include <doctest/doctest.h>
#include <filesystem>
#include "base/hash.hpp"
#include "jobs/checked_text.hpp"
#include "jobs/merge_folders.hpp"
#include "jobs/run_record.hpp"
#include "jobs/sample_parts.hpp"
#include "jobs/shards.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::change_byte;
using test::cuts;
using test::slurp;
using test::TemporaryFolder;
using test::with_waypoints;

namespace {

const RunIdentity drive_identity = test::identity;

void write_units(Shards& shards, const SampleRun& sample) {
  for (const auto& [first, count] : cuts) shards.write(sample.run(), sample.drive(first, count));
}

uint64_t hash_of(std::string_view text, size_t piece) {
  ContentHash hash;
  for (size_t at = 0; at < text.size(); at += piece) hash.add(std::as_bytes(std::span(text.substr(at, piece))));
  return hash.value();
}

}  // namespace

TEST_CASE("hashes of content are those of XXH64, however the bytes come") {
  const std::string text = "Nobody inspects the spammish repetition";
  for (const size_t piece : {1, 3, 32, 100}) {
    CHECK(hash_of("", piece) == 0xEF46DB3751D8E999u);
    CHECK(hash_of("a", piece) == 0xD24EC4F1A98C6E5Bu);
    CHECK(hash_of("abc", piece) == 0x44BC2CF5AD770999u);
    CHECK(hash_of(text, piece) == 0xFBCEA83C8A378BF1u);
  }
  const TemporaryFolder folder;
  CHECK(content_hash(folder.write("text", text)) == 0xFBCEA83C8A378BF1u);
  CHECK_FALSE(content_hash(folder.path()));
  CHECK_FALSE(content_hash(folder.path() / "absent"));
}

TEST_CASE("any byte of any file of a shard that changed is noticed by merge and by --resume, with the file's name") {
  const TemporaryFolder folder;
  const SampleRun sample = with_waypoints();
  const fs::path run = folder.path() / "run", whole = folder.path() / "whole", shards = run / "shards";
  write_outputs(whole, sample.run(), sample.drive(3, 22));
  Shards written(run, drive_identity);
  write_units(written, sample);
  size_t changes = 0;
  for (const char* suffix : {".h5", ".waypoints.h5", ".csv"}) {
    const std::string name = std::string("frames_000010_000019") + suffix;
    CAPTURE(name);
    const fs::path file = shards / name;
    const std::string bytes = slurp(file);
    for (size_t at = 0; at < bytes.size(); at += bytes.size() / 20 + 1, ++changes) {
      CAPTURE(at);
      change_byte(file, at);
      const FoundParts found = find_parts({run});
      REQUIRE(found.damaged.size() == 1);
      CHECK(found.damaged[0].find(name) != std::string::npos);
      REQUIRE(found.missing.size() == 1);
      CHECK(found.missing[0] == Unit{10, 19, 0, 1});
      std::ofstream(file, std::ios::binary) << bytes;
    }
    // A run that continues computes it again.
    change_byte(file, bytes.size() / 2);
    Shards again(run, drive_identity);
    CHECK(again.resume() == 2);
    REQUIRE(again.damaged().size() == 1);
    CHECK(again.damaged()[0].find(file.string()) == 0);
    CHECK_FALSE(again.finished({10, 19}));
    again.write(sample.run(), sample.drive(10, 10));
    again.merge(sample.run(), {});
    for (const char* output : {"paths.h5", "waypoints.h5", "links.csv"}) {
      const bool same = slurp(run / output) == slurp(whole / output);
      CHECK(same);
    }
  }
  CHECK(changes > 40);
}

TEST_CASE("a part that goes on computes its damaged shards again") {
  const TemporaryFolder folder;
  const SampleRun sample;
  {
    Shards shards(folder.path(), drive_identity);
    shards.share("0_of_1", false);
    write_units(shards, sample);
  }
  change_byte(folder.path() / "shards/frames_000020_000024.h5", 3000);
  Shards again(folder.path(), drive_identity);
  again.share("0_of_1", true);
  CHECK(again.finished({3, 9}));
  CHECK_FALSE(again.finished({20, 24}));
  CHECK(again.damaged().size() == 1);
}

TEST_CASE("any byte of run.json that changed is noticed") {
  const SampleRun sample;
  const std::string text = encode_run_record(sample.run());
  CHECK_NOTHROW(decode_run_record(text, "run.json"));
  for (size_t at = 0; at + 1 < text.size(); at += 5) {
    std::string changed = text;
    changed[at] = changed[at] == '1' ? '2' : '1';
    CAPTURE(at);
    CHECK_THROWS_AS(decode_run_record(changed, "run.json"), RuntimeError);
  }
  CHECK(check_fits(with_check("{\"a\":1}")));
  CHECK_FALSE(check_fits("{\"a\":1}"));
  CHECK_FALSE(check_fits(""));
}
