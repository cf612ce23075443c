// SPDX-License-Identifier: Apache-2.0
// Compressed tables against the same tables uncompressed, as the library reads both; and what a proof does not let
// pass.
#include "output/packed_rows.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <fstream>
#include <random>
#include "output/frame_tables.hpp"
#include "output/hdf5_read.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::change_byte;
using test::datasets;
using test::slurp;
using test::TemporaryFolder;

namespace {

// Three columns of about a megabyte, one of them offsets, one of rows of a shape, from frames of random sizes; and one
// too small to be compressed. level: of the compression.
fs::path write_tables(const fs::path& path, uint32_t level, uint32_t frames = 200) {
  std::mt19937 random(7);
  FrameTables tables(path);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    tables.group("/rows", "rows");
    std::vector<double> gain(random() % 3000), place(6 * gain.size());
    std::vector<uint64_t> offset{0};
    for (double& value : gain) {
      value = -60 - 0.01 * static_cast<double>(random() % 4000);
      offset.push_back(offset.back() + random() % 5);
    }
    for (double& value : place) value = static_cast<double>(random());
    const std::vector<uint8_t> kind(gain.size(), static_cast<uint8_t>(frame % 3));
    tables.append<double>("gain", {"dB", "numbers"}, gain);
    tables.append<double>("place", {"m", "shaped numbers"}, place, {2, 3});
    tables.append<uint64_t>("vertex_offset", {"1", "offsets"}, offset);
    tables.append<uint8_t>("kind", {"1", "bytes"}, kind);
    tables.group("/small", "rows");
    tables.append<uint32_t>("frame", {"1", "numbers"}, std::span(&frame, 1));
  }
  hdf5::File head;
  tables.finish(head, level).commit();
  return path;
}

// The filters of a dataset, by their names in the file.
std::vector<std::string> filters(const fs::path& path, const char* dataset) {
  const hdf5::File file = hdf5::File::open_to_read(path);
  const hdf5::Id id(H5Dopen2(file.id(), dataset, H5P_DEFAULT), H5Dclose, "open"),
      properties(H5Dget_create_plist(id), H5Pclose, "read");
  std::vector<std::string> out;
  for (int i = 0; i < std::max(0, H5Pget_nfilters(properties)); ++i) {
    char name[64] = "";
    unsigned flags = 0, config = 0;
    size_t values = 0;
    H5Pget_filter2(properties, static_cast<unsigned>(i), &flags, &values, nullptr, sizeof name, name, &config);
    out.push_back(name);
  }
  return out;
}

// A part of random bytes, and the pieces of it that go into a file of one compressed table.
struct Proved {
  TemporaryFolder folder;
  std::vector<fs::path> parts{folder.path() / "part"};
  Pieces pieces;
  fs::path file = folder.path() / "out.h5";

  Proved() {
    std::mt19937_64 random(3);
    std::vector<uint64_t> numbers(100000);
    for (uint64_t& number : numbers) number = random() % 1000;
    std::ofstream(parts[0], std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(8 * numbers.size()));
    std::vector<GrowingGroup> groups(1);
    groups[0] = {"/g", "numbers", {}};
    for (const char* name : {"/g/large", "/g/small"}) {
      GrowingTable& table = groups[0].tables.emplace_back(name, hdf5::Meaning{"1", "numbers"},
                                                          hdf5::Type<uint64_t>::file(), std::vector<hsize_t>());
      table.take(0, 0, name == std::string("/g/large") ? 100000 : 100);
    }
    PendingFile out(file);
    hdf5::File head;
    pieces = make_tables(out, head, groups, 1, 1);
    write_rows(parts, pieces, out, 1);
    out.sync();
    out.commit();
  }
};

}  // namespace

TEST_CASE("compressed tables read as those that are not, whatever the level, and take less") {
  const TemporaryFolder folder;
  const fs::path plain = write_tables(folder.path() / "plain.h5", 0);
  const auto expected = datasets(plain);
  REQUIRE(expected.size() == 5);
  for (const uint32_t level : {1u, 9u}) {
    CAPTURE(level);
    const fs::path packed = write_tables(folder.path() / ("packed" + std::to_string(level) + ".h5"), level);
    CHECK(datasets(packed) == expected);
    CHECK(fs::file_size(packed) < fs::file_size(plain) * 3 / 4);
    CHECK(filters(packed, "/rows/gain") == std::vector<std::string>{"shuffle", "deflate"});
    CHECK(filters(packed, "/rows/kind") == std::vector<std::string>{"shuffle", "deflate"});
    CHECK(filters(packed, "/small/frame").empty());
    CHECK(slurp(write_tables(folder.path() / "again.h5", level)) == slurp(packed));
  }
  CHECK(filters(plain, "/rows/gain").empty());
}

TEST_CASE("rows of a compressed column are read from anywhere in it, across its chunks") {
  const TemporaryFolder folder;
  const hdf5::File plain = hdf5::File::open_to_read(write_tables(folder.path() / "plain.h5", 0)),
                   packed = hdf5::File::open_to_read(write_tables(folder.path() / "packed.h5", 1));
  const hdf5::NumberColumn<double> expected(plain, "/rows/place", {2, 3}), found(packed, "/rows/place", {2, 3});
  REQUIRE(expected.rows() > 100000);
  for (const auto& [first, count] : {std::pair<hsize_t, hsize_t>{0, 1}, {5400, 200}, {70000, 20000}, {100000, 0}})
    CHECK(found.read(first, count) == expected.read(first, count));
}

TEST_CASE("a table of less than a chunk, and a frame without rows, are whole") {
  const TemporaryFolder folder;
  CHECK(datasets(write_tables(folder.path() / "a.h5", 1, 2)) == datasets(write_tables(folder.path() / "b.h5", 0, 2)));
  CHECK(datasets(write_tables(folder.path() / "c.h5", 1, 0)).empty());
}

TEST_CASE("a proof passes what is right, and names what is not: a byte of the file, of a part, a row too few") {
  const Proved right;
  CHECK_NOTHROW(prove_rows(right.parts, right.pieces, right.file));
  const uint64_t size = fs::file_size(right.file);
  const Proved part;
  change_byte(part.parts[0], 700000);
  CHECK_THROWS_WITH_AS(prove_rows(part.parts, part.pieces, part.file), doctest::Contains("/g/large does not read back"),
                       RuntimeError);
  const Proved both;
  change_byte(both.parts[0], 8);
  CHECK_THROWS_WITH_AS(prove_rows(both.parts, both.pieces, both.file), doctest::Contains("does not read back"),
                       RuntimeError);
  const Proved file;
  change_byte(file.file, size / 2);  // in a chunk
  CHECK_THROWS_AS(prove_rows(file.parts, file.pieces, file.file), RuntimeError);
  Proved more;
  more.pieces[0].push_back({0, packed_begin + 800000, 8, 0});
  CHECK_THROWS_WITH_AS(prove_rows(more.parts, more.pieces, more.file), doctest::Contains("number of its rows"),
                       RuntimeError);
}

TEST_CASE("a part that is shorter than its rows is named where they are compressed, too") {
  const Proved made;
  fs::resize_file(made.parts[0], 790000);
  CHECK_THROWS_WITH_AS(prove_rows(made.parts, made.pieces, made.file),
                       doctest::Contains((made.parts[0].string() + ": cannot be read to its end").c_str()),
                       RuntimeError);
}
