// SPDX-License-Identifier: Apache-2.0
// Chunks that were compressed before the file was begun, compared with the file that is written without them.
#include "output/packed_ahead.hpp"
#include <doctest/doctest.h>
#include <chrono>
#include <fstream>
#include <future>
#include <memory>
#include <random>
#include <thread>
#include "output/packed_rows.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::change_byte;
using test::slurp;
using test::TemporaryFolder;

namespace {

constexpr uint64_t rows_of_part = 21000, parts_count = 8;  // 65,536 and 32,768 rows are a chunk
constexpr size_t full_chunks = 2 + 5;

// Parts of a column of 4 bytes a row and one of offsets, which go on from part to part.
struct Growing {
  TemporaryFolder folder;
  std::vector<fs::path> parts;
  std::vector<GrowingGroup> groups;

  Growing() {
    GrowingGroup& group = groups.emplace_back(GrowingGroup{"/g", "numbers", {}});
    group.tables.emplace_back("/g/number", hdf5::Meaning{"1", "numbers"}, hdf5::Type<uint32_t>::file(),
                              std::vector<hsize_t>());
    group.tables.emplace_back("/g/row_offset", hdf5::Meaning{"1", "offsets"}, hdf5::Type<uint64_t>::file(),
                              std::vector<hsize_t>());
  }
  void add_part() {
    std::mt19937 random(static_cast<uint32_t>(parts.size()));
    std::vector<uint32_t> numbers(rows_of_part);
    for (uint32_t& number : numbers) number = static_cast<uint32_t>(random() % 1000);
    std::vector<uint64_t> offsets{0};
    for (uint64_t i = 0; i < rows_of_part; ++i) offsets.push_back(offsets.back() + random() % 4);
    parts.push_back(folder.path() / std::to_string(parts.size()));
    std::ofstream out(parts.back(), std::ios::binary);
    out.write(reinterpret_cast<const char*>(numbers.data()), 4 * rows_of_part);
    out.write(reinterpret_cast<const char*>(offsets.data()), 8 * (rows_of_part + 1));
    groups[0].tables[0].take(parts.size() - 1, 0, rows_of_part);
    groups[0].tables[1].take(parts.size() - 1, 4 * rows_of_part, rows_of_part + 1, offsets.back());
  }
  Pieces pieces;  // pieces of the last write()
  fs::path write(const std::string& name, const PackedAhead* ahead) {
    PendingFile out(folder.path() / name);
    hdf5::File head;
    pieces = make_tables(out, head, groups, parts.size(), 1);
    write_rows(parts, pieces, out, 1, ahead);
    out.sync();
    out.commit();
    return folder.path() / name;
  }
};

void wait_for(const PackedAhead& ahead, size_t chunks) {
  for (int i = 0; i < 3000 && ahead.count() < chunks; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

// All parts in their order, and the results.
struct Ahead {
  Growing growing;
  IdleThreads threads{2};
  PackedAhead ahead;

  explicit Ahead(uint64_t least_free_bytes = 0, size_t wanted = full_chunks)
      : ahead(threads, growing.folder.path() / "out.h5.ahead", 1, least_free_bytes) {
    for (uint64_t i = 0; i < parts_count; ++i) {
      growing.add_part();
      ahead.grow(growing.groups, growing.parts);
    }
    wait_for(ahead, wanted);
    threads.stop();
  }
  ~Ahead() { threads.stop(); }
};

}  // namespace

TEST_CASE("all full chunks are made while parts come, none of them is left in the folder, and the file is the same") {
  Ahead made;
  CHECK(made.ahead.count() == full_chunks);
  CHECK(std::distance(fs::directory_iterator(made.growing.folder.path()), {}) == parts_count);
  const std::string expected = slurp(made.growing.write("without.h5", nullptr));
  // A row that was read before is not read again: this chunk has its earlier bytes.
  change_byte(made.growing.parts[0], 0);
  const fs::path with = made.growing.write("with.h5", &made.ahead);
  CHECK(slurp(with) == expected);
  CHECK(slurp(made.growing.write("other.h5", nullptr)) != expected);
  CHECK_NOTHROW(prove_rows(made.growing.parts, made.growing.pieces, with, &made.ahead));
}

TEST_CASE("a proof finds a byte of a chunk that was made ahead, and one of a part that is behind those") {
  Ahead made;
  const fs::path file = made.growing.write("out.h5", &made.ahead);
  REQUIRE_NOTHROW(prove_rows(made.growing.parts, made.growing.pieces, file, &made.ahead));
  change_byte(made.growing.parts.back(), 4 * rows_of_part - 1);  // the last number, in no full chunk
  CHECK_THROWS_WITH_AS(prove_rows(made.growing.parts, made.growing.pieces, file, &made.ahead),
                       doctest::Contains("/g/number does not read back"), RuntimeError);
  change_byte(made.growing.parts.back(), 4 * rows_of_part - 1);
  REQUIRE_NOTHROW(prove_rows(made.growing.parts, made.growing.pieces, file, &made.ahead));
  change_byte(file, fs::file_size(file) / 2);
  CHECK_THROWS_AS(prove_rows(made.growing.parts, made.growing.pieces, file, &made.ahead), RuntimeError);
}

TEST_CASE("where the disk is nearly full or a part cannot be read, nothing is made, and writing says what is wrong") {
  Ahead full(uint64_t{1} << 60, 0);
  CHECK(full.ahead.count() == 0);
  CHECK(slurp(full.growing.write("with.h5", &full.ahead)) == slurp(full.growing.write("without.h5", nullptr)));

  Growing growing;
  IdleThreads threads(1);
  PackedAhead ahead(threads, growing.folder.path() / "out.h5.ahead", 1, 0);
  for (uint64_t i = 0; i < parts_count; ++i) growing.add_part();
  fs::resize_file(growing.parts[0], 1000);
  ahead.grow(growing.groups, growing.parts);
  std::promise<void> tried;  // by the one thread, which does tasks in their order
  threads.enqueue([&tried] { tried.set_value(); });
  tried.get_future().wait();
  threads.stop();
  CHECK(ahead.count() == 0);
  CHECK_THROWS_WITH_AS(growing.write("out.h5", &ahead), doctest::Contains("cannot be read to its end"), RuntimeError);
}

TEST_CASE("threads of low priority do tasks in their order, and none after they were stopped") {
  std::vector<int> done;
  IdleThreads threads(1);
  std::atomic<bool> begun = false, go_on = false;
  threads.enqueue([&] {
    begun = true;
    while (!go_on) std::this_thread::yield();
    done.push_back(0);
  });
  threads.enqueue([&] { done.push_back(1); });
  while (!begun) std::this_thread::yield();
  std::thread stopping([&] { threads.stop(); });
  // A task that is enqueued and dropped at once, instead of being kept with the others, tells that stop() has begun.
  for (bool stopped = false; !stopped; std::this_thread::yield()) {
    const auto kept = std::make_shared<int>(0);
    threads.enqueue([kept] {});
    stopped = kept.use_count() == 1;
  }
  go_on = true;
  stopping.join();
  threads.enqueue([&] { done.push_back(2); });
  CHECK(done == std::vector<int>{0});  // the one that had begun
}
