// SPDX-License-Identifier: Apache-2.0
// Outputs with the name of a link, a pipe, a device, a socket or a disk: the existing object is kept.
// Devices are nodes of the test's own, never those of /dev; if no node can be made, that part is skipped.
#include "base/output_place.hpp"
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>
#include <fstream>
#include <future>
#include <span>
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/pending_folder.hpp"
#include "output/reader.hpp"
#include "output/sample_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/output.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::slurp;
using test::TemporaryFolder;

namespace {

// Returns false, with a message, if this process may make none.
bool make_device(const fs::path& path, mode_t kind, unsigned minor_number) {
  if (mknod(path.c_str(), kind | 0600, makedev(kind == S_IFCHR ? 1 : 7, minor_number)) == 0) {
    // Containers allow nodes to be made that nobody may open.
    if (const int file = ::open(path.c_str(), O_WRONLY | O_NONBLOCK); file >= 0) return ::close(file) == 0;
    if (kind == S_IFBLK) return true;
  }
  MESSAGE("left out: no device can be made here");
  return false;
}

fs::file_type type_of(const fs::path& path) { return fs::symlink_status(path).type(); }

size_t files_in(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

constexpr unsigned null_minor = 3, full_minor = 7;

}  // namespace

TEST_CASE("a file behind links is replaced, and the links stay") {
  const TemporaryFolder folder;
  const fs::path there = folder.path() / "there", link = folder.path() / "link", far = folder.path() / "far";
  fs::create_directory(folder.path() / "disk");
  fs::create_symlink("disk/file", far);  // to a file that is not there yet
  fs::create_symlink("far", link);
  write_file(link, "one");
  CHECK(type_of(link) == fs::file_type::symlink);
  CHECK(type_of(far) == fs::file_type::symlink);
  CHECK(slurp(folder.path() / "disk/file") == "one");
  write_file(link, "two");
  CHECK(type_of(link) == fs::file_type::symlink);
  CHECK(slurp(folder.path() / "disk/file") == "two");
  CHECK(files_in(folder.path() / "disk") == 1);
  fs::create_symlink("circle", folder.path() / "circle");
  CHECK_THROWS_WITH_AS(write_file(folder.path() / "circle", "x"), doctest::Contains("symbolic links"), RuntimeError);
  CHECK(type_of(folder.path() / "circle") == fs::file_type::symlink);
}

TEST_CASE("a pipe gets the bytes and stays a pipe; one that nobody reads any more is an error") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const std::string text(300000, 'x');
  auto reading = std::async(std::launch::async, [&] { return slurp(pipe); });
  write_file(pipe, text);
  CHECK(reading.get() == text);
  CHECK(type_of(pipe) == fs::file_type::fifo);
  CHECK(files_in(folder.path()) == 1);

  auto gone = std::async(std::launch::async, [&] { ::close(::open(pipe.c_str(), O_RDONLY)); });
  CHECK_THROWS_WITH_AS(write_file(pipe, std::string(3000000, 'x')), doctest::Contains("Broken pipe"), RuntimeError);
  gone.get();
  CHECK(type_of(pipe) == fs::file_type::fifo);
}

TEST_CASE("devices are written to and stay devices; a full one is an error") {
  const TemporaryFolder folder;
  const fs::path null = folder.path() / "null", full = folder.path() / "full", link = folder.path() / "link";
  if (make_device(null, S_IFCHR, null_minor) && make_device(full, S_IFCHR, full_minor)) {
    write_file(null, "text");
    fs::create_symlink("null", link);
    write_file(link, "text");
    CHECK(type_of(link) == fs::file_type::symlink);
    CHECK(type_of(null) == fs::file_type::character);
    CHECK_THROWS_WITH_AS(write_file(full, "text"), doctest::Contains("No space left"), RuntimeError);
    CHECK(type_of(full) == fs::file_type::character);
    // An error removes files that appear together again, if they are plain files.
    std::vector<PendingFile> files;
    for (const char* name : {"first", "null", "full"})
      files.emplace_back(folder.path() / name, std::as_bytes(std::span(std::string_view("text"))));
    CHECK_THROWS_AS(commit_together(files), RuntimeError);
    files.clear();
    CHECK(type_of(null) == fs::file_type::character);
    CHECK_FALSE(fs::exists(folder.path() / "first"));
    CHECK(files_in(folder.path()) == 3);
  }
  const fs::path disk = folder.path() / "disk";
  if (make_device(disk, S_IFBLK, 250)) {
    CHECK_THROWS_WITH_AS(write_file(disk, "text"), doctest::Contains("it is a disk"), RuntimeError);
    CHECK(type_of(disk) == fs::file_type::block);
  }
}

TEST_CASE("sockets and folders are refused and stay") {
  const TemporaryFolder folder;
  const fs::path place = folder.path() / "socket";
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  place.string().copy(address.sun_path, sizeof address.sun_path - 1);
  REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  CHECK_THROWS_WITH_AS(write_file(place, "text"), doctest::Contains("it is a socket"), RuntimeError);
  CHECK(type_of(place) == fs::file_type::socket);
  ::close(socket);
  CHECK_THROWS_WITH_AS(write_file(folder.path(), "text"), doctest::Contains("Is a directory"), RuntimeError);
}

TEST_CASE("bytes at places and files that are reserved reach a pipe, too") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  auto reading = std::async(std::launch::async, [&] { return slurp(pipe); });
  PendingFile file(pipe);
  file.reserve(6);
  file.write_at(3, std::as_bytes(std::span(std::string_view("def"))));
  file.write_at(0, std::as_bytes(std::span(std::string_view("abc"))));
  CHECK(slurp(file.temporary()) == "abcdef");
  file.sync();
  file.commit();
  CHECK(reading.get() == "abcdef");
}

TEST_CASE("a folder behind a link is made there, and what is no folder is refused") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "disk");
  fs::create_symlink("disk/new", folder.path() / "link");
  PendingFolder made(folder.path() / "link");
  made.append("a/b", "text");
  made.commit();
  CHECK(type_of(folder.path() / "link") == fs::file_type::symlink);
  CHECK(slurp(folder.path() / "disk/new/a/b") == "text");
  CHECK_THROWS_AS(PendingFolder(folder.path() / "link"), InputError);
  // Files that join others keep links among them.
  fs::create_symlink("../far", folder.path() / "disk/new/far");
  PendingFolder more(folder.path() / "link", PendingFolder::Earlier::kept);
  more.append("far", "beyond");
  more.append("near", "here");
  more.commit();
  CHECK(type_of(folder.path() / "disk/new/far") == fs::file_type::symlink);
  CHECK(slurp(folder.path() / "disk/far") == "beyond");
  CHECK(slurp(folder.path() / "disk/new/near") == "here");
  CHECK(files_in(folder.path() / "disk") == 2);
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH_AS(PendingFolder{pipe}, doctest::Contains("this is no folder"), InputError);
  CHECK(type_of(pipe) == fs::file_type::fifo);
}

TEST_CASE("outputs of a run follow links, also where an earlier run left one that is not made again") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", disk = folder.path() / "disk";
  fs::create_directories(out);
  fs::create_directory(disk);
  for (const char* name : {"paths.h5", "waypoints.h5"}) fs::create_symlink(disk / name, out / name);
  SampleRun sample;
  sample.config.output.waypoints = 2;
  write_outputs(out, sample.run(), sample.frames());
  CHECK(fs::file_size(disk / "paths.h5") > 1000);
  CHECK(fs::file_size(disk / "waypoints.h5") > 1000);
  sample.config.output.waypoints = 0;
  write_outputs(out, sample.run(), sample.frames());
  for (const char* name : {"paths.h5", "waypoints.h5"}) CHECK(type_of(out / name) == fs::file_type::symlink);
  CHECK(fs::exists(disk / "paths.h5"));
  CHECK_FALSE(fs::exists(disk / "waypoints.h5"));
  // Shards may lie on another disk, too.
  fs::create_directory(disk / "shards");
  fs::create_directory_symlink(disk / "shards", out / "shards");
  Shards shards(out, sample_identity(24));
  shards.write(sample.run(), sample.drive(3, 22));
  shards.merge(sample.run(), {});
  CHECK(type_of(out / "shards") == fs::file_type::symlink);
  CHECK(fs::exists(disk / "shards/frames_000003_000024.h5"));
  Shards(out, sample_identity(24)).clear();
  CHECK(type_of(out / "shards") == fs::file_type::symlink);
  CHECK_FALSE(fs::exists(disk / "shards/frames_000003_000024.h5"));
}

TEST_CASE("what hinders writing is found by writing") {
  const TemporaryFolder folder;
  CHECK(write_obstacle(folder.path()).empty());
  CHECK(write_obstacle(folder.path() / "not/there/yet").empty());
  CHECK(files_in(folder.path()) == 0);
  CHECK(write_obstacle("/proc/x").find("/proc") == 0);
  CHECK(write_obstacle(folder.write("file", "") / "below").find("not a folder") != std::string::npos);
}
