// SPDX-License-Identifier: Apache-2.0
// The cut of a run, and the assignment of its parts: units, process files, claims.
// Processes are this one, a child of it that has ended, and invented ones of another machine.
#include "jobs/units.hpp"
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <set>
#include <thread>
#include "jobs/claims.hpp"
#include "jobs/process_files.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::TemporaryFolder;

namespace {

// Returns the file content of a process that has ended.
ProcessInfo dead_process(const std::string& job) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string text = encode_process(this_process(job, 1));
    const bool sent = ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    _exit(sent ? 0 : 1);
  }
  char text[4096];
  const ssize_t bytes = ::read(ends[0], text, sizeof text);
  waitpid(child, nullptr, 0);
  close(ends[0]);
  close(ends[1]);
  REQUIRE(bytes > 0);
  const auto process = decode_process({text, static_cast<size_t>(bytes)});
  REQUIRE(process);
  return *process;
}

void leave_file(const TemporaryFolder& folder, const ProcessInfo& process) {
  folder.write("process_" + process.name, encode_process(process));
}

}  // namespace

TEST_CASE("units cover every frame once and begin at absolute multiples of the shard length") {
  for (const auto& [first, last, length] :
       {std::tuple{0u, 59u, 5u}, {20u, 32u, 5u}, {3u, 24u, 10u}, {7u, 7u, 100u}, {0u, 99u, 100u}, {99u, 100u, 100u}}) {
    CAPTURE(first);
    const Units units(first, last, length);
    uint64_t next = first;
    for (uint64_t i = 0; i < units.count(); ++i) {
      const Unit unit = units.at(i);
      CHECK(unit.first == next);
      if (i > 0) CHECK(unit.first % length == 0);
      CHECK(unit.frames() <= length);
      next = uint64_t{unit.last} + 1;
    }
    CHECK(next == uint64_t{last} + 1);
  }
  const Units all(0, 0xFFFFFFFFu, 1);
  CHECK(all.count() == uint64_t{1} << 32);
  CHECK(all.at(all.count() - 1).last == 0xFFFFFFFFu);
  const Units blocks(0, 0, 100, 3);
  CHECK(blocks.count() == 3);
  CHECK(blocks.at(2) == Unit{0, 0, 2, 3});
  CHECK(unit_words(blocks.at(2)) == "block 3 of 3");
  CHECK(unit_name({3, 9, 0, 1}) == "frames_000003_000009");
}

TEST_CASE("a loop over units skips what is finished, computes what is chosen, and counts the rest") {
  const Units units(0, 9, 1);
  const auto visited = [&](const UnitOrder& order, const std::set<uint32_t>& finished, auto choose, bool whole = true) {
    std::vector<uint32_t> chosen, computed;
    const UnitCounts counts =
        for_each_unit(units, order,
                      {.finished = [&](const Unit& unit) { return finished.contains(unit.first); },
                       .choose =
                           [&](const Unit& unit) {
                             chosen.push_back(unit.first);
                             return choose(unit.first);
                           },
                       .compute =
                           [&](const Unit& unit) {
                             computed.push_back(unit.first);
                             return whole;
                           }});
    return std::tuple{chosen, computed, counts};
  };
  using List = std::vector<uint32_t>;
  const auto all = [](uint32_t) { return UnitChoice::compute; };

  // The second of three ranks begins with its own unit and comes to all.
  const auto [wrapped, wrapped_computed, wrapped_counts] = visited({.first = 7, .count = 10}, {8, 0}, all);
  CHECK(wrapped == List{7, 9, 1, 2, 3, 4, 5, 6});
  CHECK(wrapped_computed == wrapped);
  CHECK(wrapped_counts.computed == 8);
  CHECK(wrapped_counts.missing() == 0);

  // Part 1 of 4 has units 1, 5 and 9.
  const auto [part, part_computed, part_counts] = visited({.first = 1, .step = 4, .count = 3}, {5}, all);
  CHECK(part == List{1, 9});

  // An interrupt in the middle of a unit leaves it.
  const auto [cut, cut_computed, cut_counts] = visited({.count = 10}, {}, all, false);
  CHECK(cut_computed.size() == 10);
  CHECK(cut_counts.computed == 0);
  CHECK(cut_counts.left == 10);

  const auto [mixed, mixed_computed, mixed_counts] = visited({.count = 10}, {2}, [](uint32_t first) {
    if (first == 7) return UnitChoice::stop;
    if (first % 3 == 0) return UnitChoice::elsewhere;
    return first == 4 ? UnitChoice::leave : UnitChoice::compute;
  });
  CHECK(mixed == List{0, 1, 3, 4, 5, 6, 7});
  CHECK(mixed_computed == List{1, 5});
  CHECK(mixed_counts.computed == 2);
  CHECK(mixed_counts.elsewhere == 3);
  CHECK(mixed_counts.left == 1);
  CHECK(mixed_counts.missing() == 4);
}

TEST_CASE("a process is alive while it runs; elsewhere, while its heart beats") {
  const ProcessInfo me = this_process("job", 3);
  CHECK(alive(me));
  const auto copy = decode_process(encode_process(me));
  REQUIRE(copy);
  CHECK(copy->name == me.name);
  CHECK(copy->rank == 3);
  ProcessInfo other = me;
  other.start += 1;  // another process has its number now
  CHECK_FALSE(alive(other));
  CHECK_FALSE(alive(dead_process("job")));
  other.machine = "elsewhere";
  other.age_s = heartbeat_limit_s - 1;
  CHECK(alive(other));
  other.age_s = heartbeat_limit_s + 1;
  CHECK_FALSE(alive(other));
}

TEST_CASE("whatever stands in a process file, it is read or passed over") {
  for (const char* text : {"", "{", "[]", "3", "null", "{\"name\":3}", "{\"name\":\"a\"}", "\xff\xfe"})
    CHECK_FALSE(decode_process(text));
  ProcessInfo me = this_process("job", 3);
  me.rank = 7;
  for (const char* rank : {"1e122", "-7", "7.5", "4294967303"}) {
    std::string text = encode_process(me);
    text.replace(text.find("\"rank\":7") + 7, 1, rank);
    CAPTURE(text);
    CHECK_FALSE(decode_process(text));
  }
  CHECK_FALSE(decode_process(std::string(100000, '[')));
  const TemporaryFolder folder;
  folder.write("process_a", "{\"name\":");
  folder.write("process_b", encode_process(this_process("job", 0)));  // under another name than its own
  CHECK(processes_in(folder.path()).empty());
}

TEST_CASE("a folder in use by another job is refused, and free again when its process is gone") {
  const TemporaryFolder folder;
  {
    const Presence mine(folder.path(), this_process("job", 0));
    CHECK(processes_in(folder.path()).size() == 1);
    const Presence ours(folder.path(), this_process("job", 1));
    CHECK_NOTHROW(check_not_in_use(folder.path(), this_process("job", 2)));
    CHECK_THROWS_WITH_AS(check_not_in_use(folder.path()), doctest::Contains("writes there since 20"), RuntimeError);
    CHECK_THROWS_AS(check_not_in_use(folder.path(), this_process("job", 1)), RuntimeError);  // the same part twice
    CHECK_THROWS_AS(Presence(folder.path(), this_process("other", 0)), RuntimeError);
    CHECK_THROWS_AS(Presence(folder.path(), this_process("", 2)), RuntimeError);
    CHECK(processes_in(folder.path()).size() == 2);
  }
  CHECK(fs::is_empty(folder.path()));
  leave_file(folder, dead_process("job"));
  check_not_in_use(folder.path(), this_process("other", 0));
  leave_file(folder, dead_process(""));
  { const Presence next(folder.path(), this_process("", 0)); }  // it removes the files of dead processes
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("of eight processes that enter a folder at once one has it") {
  const TemporaryFolder folder;
  int held = 0;
  std::vector<pid_t> children;
  for (int i = 0; i < 8; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      const std::string tried = "tried_" + std::to_string(i);
      try {
        const Presence mine(folder.path(), this_process("", 0));
        folder.write(tried, "");
        while (!fs::exists(folder.path() / "go")) usleep(1000);
        _exit(0);
      } catch (const RuntimeError&) {
        folder.write(tried, "");
        _exit(1);
      }
    }
    children.push_back(child);
  }
  for (int i = 0; i < 8; ++i)
    while (!fs::exists(folder.path() / ("tried_" + std::to_string(i)))) usleep(1000);
  folder.write("go", "");
  for (const pid_t child : children) {
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    held += WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  CHECK(held == 1);
}

TEST_CASE("a task is taken by one process; one that died is followed by one other, and no third") {
  const TemporaryFolder folder;
  const Presence first(folder.path(), this_process("job", 0)), second(folder.path(), this_process("job", 1));
  Claims a(folder.path(), first.process()), b(folder.path(), second.process());
  a.look();
  b.look();
  CHECK(a.take("x"));
  CHECK_FALSE(a.take("x"));
  CHECK_FALSE(b.take("x"));  // although it has not looked since
  b.look();
  CHECK(b.state("x") == ClaimState::taken);
  CHECK(b.state("y") == ClaimState::free);

  const ProcessInfo dead = dead_process("job");
  leave_file(folder, dead);
  Claims killed(folder.path(), dead);
  CHECK(killed.take("z"));
  a.look();
  CHECK(a.state("z") == ClaimState::free);
  Claims again(folder.path(), dead);
  again.look();
  CHECK(again.take("z"));  // the second process to die over it
  a.look();
  CHECK(a.state("z") == ClaimState::failed);
  CHECK_FALSE(a.take("z"));
  remove_claims(folder.path());
  a.look();
  CHECK(a.state("x") == ClaimState::free);
}

TEST_CASE("eight processes that want the same hundred tasks do each once") {
  const TemporaryFolder folder;
  const Presence here(folder.path(), this_process("job", 0));
  std::vector<std::set<std::string>> done(8);
  std::vector<std::thread> threads;
  for (auto& mine : done)
    threads.emplace_back([&] {
      Claims claims(folder.path(), here.process());
      for (int i = 0; i < 100; ++i)
        if (const std::string task = std::to_string(i); claims.take(task)) mine.insert(task);
    });
  for (std::thread& thread : threads) thread.join();
  size_t sum = 0;
  std::set<std::string> all;
  for (const auto& mine : done) {
    sum += mine.size();
    all.insert(mine.begin(), mine.end());
  }
  CHECK(sum == 100);
  CHECK(all.size() == 100);
}
