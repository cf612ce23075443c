// SPDX-License-Identifier: Apache-2.0
// The rules about which thread may do what, and in which order: breaking one is an error that names it. Frames are
// invented.
#include <doctest/doctest.h>
#include <functional>
#include <stdexcept>
#include <thread>
#include "base/guarded.hpp"
#include "base/one_thread.hpp"
#include "jobs/sample_parts.hpp"
#include "jobs/unit_writer.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::identity;
using test::names;
using test::TemporaryFolder;

namespace {

// Tells whether another thread is refused when it does this.
bool refused_elsewhere(const std::function<void()>& use) {
  bool refused = false;
  std::thread([&] {
    try {
      use();
    } catch (const std::logic_error&) {
      refused = true;
    }
  }).join();
  return refused;
}

void add_frames(UnitWriter& writer, const SampleRun& sample, uint32_t first, uint32_t count) {
  for (FrameResult& frame : sample.drive(first, count)) writer.add(std::move(frame));
}

}  // namespace

TEST_CASE("a guarded value is used by one thread at a time, and waiting threads see its changes") {
  Guarded<std::vector<int>> list;
  std::thread other([&] {
    for (int i = 0; i < 1000; ++i) list.with([i](std::vector<int>& values) { values.push_back(i); });
  });
  for (int i = 0; i < 1000; ++i) list.with([i](std::vector<int>& values) { values.push_back(i); });
  const auto full = [](const std::vector<int>& values) { return values.size() == 2000; };
  CHECK(list.when(full, [](std::vector<int>& values) { return values.size(); }) == 2000);
  other.join();
  CHECK_THROWS_AS(list.with([](std::vector<int>&) { throw std::runtime_error("inside"); }), std::runtime_error);
  CHECK(list.with([](std::vector<int>& values) { return values.size(); }) == 2000);  // the lock was given back
}

TEST_CASE("finished units are known to one thread; others may write units only") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const Run run = sample.run();
  Shards shards(folder.path(), identity);
  CHECK(refused_elsewhere([&] { (void)shards.finished({3, 9}); }));
  CHECK(refused_elsewhere([&] { (void)shards.count(); }));
  CHECK(refused_elsewhere([&] { (void)shards.complete(); }));
  CHECK(refused_elsewhere([&] { (void)shards.totals(); }));
  CHECK(refused_elsewhere([&] { shards.look(); }));
  CHECK(refused_elsewhere([&] { shards.resume(); }));
  CHECK(refused_elsewhere([&] { shards.merge(run, {}); }));
  CHECK_FALSE(refused_elsewhere([&] {
    const auto unit = shards.open(run, {3, 9});
    for (const FrameResult& frame : sample.drive(3, 7)) unit->add(frame);
    shards.close(*unit);
  }));
  CHECK_FALSE(shards.finished({3, 9}));
  CHECK(names(folder.path() / "shards").size() == 4);  // its two files, manifest, run.json
}

TEST_CASE("units that a thread writes count as finished after finish(); the open one can be taken") {
  const TemporaryFolder folder;
  const SampleRun sample;
  const Run run = sample.run();
  Shards shards(folder.path(), identity);
  Progress progress;
  UnitWriter writer(run, shards, progress);
  writer.follow(std::make_unique<MergeAhead>(sample.config, Units(3, 24, 10), folder.path()));
  writer.begin({3, 9});
  add_frames(writer, sample, 3, 7);
  writer.end();
  writer.begin({20, 24});
  add_frames(writer, sample, 20, 2);
  writer.drop();
  writer.finish();
  CHECK(shards.finished({3, 9}));
  const std::optional<FrameResult> written = writer.take_written();
  REQUIRE(written);
  CHECK(written->frame == 21);
  CHECK_FALSE(writer.take_written());
  CHECK_FALSE(shards.finished({20, 24}));
  CHECK_FALSE(writer.take_unfinished());
  CHECK(refused_elsewhere([&] { writer.finish(); }));
  CHECK(refused_elsewhere([&] { writer.begin({10, 19}); }));
  writer.begin({10, 19});
  add_frames(writer, sample, 10, 4);
  const auto unfinished = writer.take_unfinished();
  REQUIRE(unfinished);
  CHECK(unfinished->totals().frames == 4);
  CHECK(shards.count() == 1);
  CHECK(writer.take_ahead());
  CHECK_FALSE(writer.take_ahead());
}

TEST_CASE("the writer refuses frames without a unit, and units within a unit") {
  const SampleRun sample;
  const Run run = sample.run();
  Progress progress;
  const auto message = [&](auto use) -> std::string {
    const TemporaryFolder folder;
    Shards shards(folder.path(), identity);
    UnitWriter writer(run, shards, progress);
    try {
      use(writer);
      writer.finish();
    } catch (const std::logic_error& error) {
      CHECK_THROWS_AS(writer.finish(), std::logic_error);  // it stays so
      return error.what();
    }
    return "";
  };
  CHECK(message([&](UnitWriter& writer) { add_frames(writer, sample, 3, 1); }) ==
        "unit writer: a frame came without a unit");
  CHECK(message([&](UnitWriter& writer) { writer.end(); }) == "unit writer: no unit was begun that could end");
  CHECK(message([&](UnitWriter& writer) {
          writer.begin({3, 9});
          writer.begin({10, 19});
        }) == "unit writer: a unit was begun before the one before was ended");
  CHECK(message([&](UnitWriter& writer) {
          writer.begin({3, 9});
          writer.drop();
          writer.begin({10, 19});
        }).empty());
}

TEST_CASE("the state of a folder changes along its transitions only") {
  using Holds = FolderState::Holds;
  FolderState alone;
  CHECK(alone.holds() == Holds::earlier);
  alone.take_over();
  CHECK(alone.holds() == Holds::continued);
  CHECK_THROWS_AS(alone.take_over(), std::logic_error);
  alone.unit_in_place();
  CHECK(alone.holds() == Holds::own);
  alone.unit_in_place();
  CHECK(alone.holds() == Holds::own);
  CHECK_THROWS_AS(alone.take_over(), std::logic_error);
  CHECK_THROWS_AS(alone.share(), std::logic_error);
  FolderState rank;
  rank.take_over();
  rank.share();
  CHECK(rank.holds() == Holds::joined);
  CHECK_THROWS_AS(rank.share(), std::logic_error);
  CHECK_THROWS_AS(rank.take_over(), std::logic_error);
  rank.unit_in_place();
  CHECK(rank.holds() == Holds::shared);
  rank.unit_in_place();
  CHECK(rank.holds() == Holds::shared);
  CHECK_THROWS_AS(rank.share(), std::logic_error);
  FolderState first;
  first.unit_in_place();
  CHECK(first.holds() == Holds::own);
}

TEST_CASE("a merge that was made ahead looks at nothing more once the merge has begun") {
  const TemporaryFolder folder;
  const SampleRun sample;
  Shards shards(folder.path(), identity);
  MergeAhead ahead(sample.config, Units(3, 24, 10), folder.path());
  shards.write(sample.run(), sample.drive(3, 7));
  ahead.look();
  const std::vector<std::filesystem::path> parts{folder.path() / "shards" / "frames_000003_000009.h5"};
  const OutputAhead* const known = ahead.of(0, parts);
  REQUIRE(known);
  shards.write(sample.run(), sample.drive(10, 10));
  ahead.look();
  CHECK(known->parts.parts() == parts);
}
