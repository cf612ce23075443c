// SPDX-License-Identifier: Apache-2.0
// Bytes of many files are copied into one and compared with the same done in memory; impossible copies are refused.
#include "output/copy_pieces.hpp"
#include <doctest/doctest.h>
#include <cstring>
#include <fstream>
#include <random>
#include "output/hdf5.hpp"
#include "output/merge_h5.hpp"
#include "output/reader.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;

namespace {

std::string random_bytes(size_t count, std::mt19937& random) {
  std::string out(count, '\0');
  for (char& c : out) c = static_cast<char>(random());
  return out;
}

std::string counted_on(std::string numbers, uint64_t base) {
  for (size_t at = 0; at < numbers.size(); at += sizeof base) {
    uint64_t number;
    std::memcpy(&number, &numbers[at], sizeof number);
    number += base;
    std::memcpy(&numbers[at], &number, sizeof number);
  }
  return numbers;
}

}  // namespace

TEST_CASE("pieces of many parts, larger and smaller than a block, come where they belong") {
  const TemporaryFolder folder;
  std::mt19937 random(1);
  std::vector<fs::path> parts;
  Pieces pieces;
  std::string expected(size_t{40} << 20, '\0');
  uint64_t end = 5;
  for (int i = 0; i < 12; ++i) {
    const std::string bytes = random_bytes(random() % (size_t{3} << 20), random);
    parts.push_back(folder.path() / std::to_string(i));
    std::ofstream(parts.back(), std::ios::binary) << bytes;
    const uint64_t from = bytes.size() / 3, numbers = bytes.size() / 3 / 8 * 8, base = random() % 3 * 1000;
    pieces.push_back({{from, end, numbers, base}, {0, end + numbers, from, 0}, {7, end, 0, 1}});
    expected.replace(end, numbers, counted_on(bytes.substr(from, numbers), base));
    expected.replace(end + numbers, from, bytes.substr(0, from));
    end += numbers + from;
  }
  expected.resize(end);
  PendingFile file(folder.path() / "out");
  copy_pieces(parts, pieces, file);
  file.sync();
  file.commit();
  CHECK(slurp(folder.path() / "out") == expected);
}

TEST_CASE("a part that is shorter than its pieces, or gone, is named") {
  const TemporaryFolder folder;
  const std::vector<fs::path> parts{folder.path() / "a"};
  std::ofstream(parts[0]) << "abc";
  const PendingFile file(folder.path() / "out");
  CHECK_THROWS_WITH_AS(copy_pieces(parts, {{{0, 0, 4, 0}}}, file),
                       doctest::Contains((parts[0].string() + ": cannot be read to its end").c_str()), RuntimeError);
  CHECK_THROWS_AS(copy_pieces(parts, {{{9, 0, 1, 0}}}, file), RuntimeError);
  fs::remove(parts[0]);
  CHECK_THROWS_AS(copy_pieces(parts, {{{0, 0, 1, 0}}}, file), RuntimeError);
}

TEST_CASE("parts whose rows differ in size are not merged") {
  const TemporaryFolder folder;
  const std::vector<fs::path> parts{folder.path() / "a.h5", folder.path() / "b.h5"};
  for (hsize_t i = 0; i < 2; ++i) {
    hdf5::File h5;
    h5.make_group("/g", "numbers");
    const std::vector<uint32_t> row(i + 1);
    hdf5::Rows<uint32_t>(h5, "/g/x", {"1", "numbers"}, {1, i + 1}).append(row);
    std::ofstream(parts[i], std::ios::binary)
        .write(reinterpret_cast<const char*>(h5.image().data()), static_cast<std::streamsize>(h5.image().size()));
  }
  const std::vector<std::string> groups{"/g"};
  CHECK_THROWS_WITH_AS(growing_groups_of(parts, groups, [](const fs::path&) {}),
                       doctest::Contains((parts[1].string() + ": /g/x has another shape or type").c_str()), InputError);
}

TEST_CASE("room for rows is where the library then reads them, and rows in chunks are refused") {
  const TemporaryFolder folder;
  PendingFile file(folder.path() / "a.h5");
  hdf5::File empty;
  file.write(empty.image());
  uint64_t room = 0;
  {
    hdf5::File h5 = hdf5::File::open_to_write(file.temporary());
    room = hdf5::make_room(h5, "/numbers", {"1", "numbers"}, hdf5::Type<uint32_t>::file(), {3, 2});
    CHECK(hdf5::make_room(h5, "/none", {"1", "no rows"}, hdf5::Type<uint32_t>::file(), {0, 2}) == 0);
    h5.flush();
  }
  const std::vector<uint32_t> values{1, 2, 3, 4, 5, 6};
  file.write_at(room, std::as_bytes(std::span(values)));
  const hdf5::File h5 = hdf5::File::open_to_write(file.temporary());
  std::vector<uint32_t> found(6);
  {
    const hdf5::Id dataset(H5Dopen2(h5.id(), "/numbers", H5P_DEFAULT), H5Dclose, "open");
    H5Dread(dataset, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, found.data());
    CHECK(found == values);
    CHECK_NOTHROW(hdf5::check_stored(dataset, "/numbers"));
  }
  const hdf5::Extent extent = hdf5::Column(h5, "/numbers").extent();
  CHECK((extent.rows == 3 && extent.row_bytes == 8 && extent.offset == room));
  CHECK(hdf5::Column(h5, "/none").extent().rows == 0);

  const hsize_t shape[] = {3};
  const hdf5::Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make"),
      space(H5Screate_simple(1, shape, nullptr), H5Sclose, "make");
  H5Pset_chunk(creation, 1, shape);
  const hdf5::Id chunked(H5Dcreate2(h5.id(), "chunked", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                         H5Dclose, "make");
  CHECK_THROWS_WITH_AS(hdf5::check_stored(chunked, "/chunked"), doctest::Contains("cut short"), RuntimeError);
  const std::vector<uint8_t> three{1, 2, 3};
  H5Dwrite(chunked, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, three.data());
  CHECK_THROWS_WITH_AS(hdf5::Column(h5, "/chunked").extent(), doctest::Contains("not stored in one piece"),
                       RuntimeError);
}
