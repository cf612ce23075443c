// SPDX-License-Identifier: Apache-2.0
// Caches of compiled kernels that cannot be written to: PoCL's own, without which it offers no device, and ours. /proc
// takes no files, not even root's. The cases are skipped with a message if there is no OpenCL device.
#include <doctest/doctest.h>
#include "program.hpp"

namespace {

const std::string two_ends =
    "scene.generate = \"--blocks 2\"\ntrace.rays = 1000\ntrace.max_depth = 1\n"
    "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [50, 0, 2]\n";

// Tells that the list of devices has PoCL's alone.
bool only_pocl(const std::string& devices) {
  size_t rows = 0, pocl = 0;
  for (size_t at = 0, end; (end = devices.find('\n', at)) != std::string::npos; at = end + 1, ++rows)
    pocl += devices.substr(at, end - at).find("Portable Computing Language") != std::string::npos;
  return pocl > 0 && rows == pocl + 1;
}

}  // namespace

TEST_CASE(
    "where PoCL cannot write its cache it gets another one, with a word; a chosen one is an error that names it") {
  const Outcome devices = run_program({"devices"});
  if (!only_pocl(devices.out)) {
    MESSAGE("skipped: this is about a machine with PoCL alone");
    return;
  }
  for (const std::string& temporary : {std::string("TMPDIR=/nowhere"), std::string("TMPDIR=/tmp")}) {
    const Outcome moved = run_program({"devices"}, {"HOME=/proc", "XDG_CACHE_HOME=", "POCL_CACHE_DIR=", temporary});
    CAPTURE(moved.err);
    CHECK(moved.code == 0);
    CHECK(moved.out == devices.out);
    CHECK(contains(moved.err, "PoCL, the OpenCL of CPUs, cannot write its cache (/proc"));
    CHECK(contains(moved.err, "set POCL_CACHE_DIR"));
  }
  const Outcome chosen = run_program({"devices"}, {"POCL_CACHE_DIR=/proc/x"});
  CAPTURE(chosen.err);
  CHECK(chosen.code == 4);
  CHECK(contains(chosen.err, "PoCL, the OpenCL of CPUs, is installed, but it cannot write its cache (/proc"));
  CHECK(contains(chosen.err, "set POCL_CACHE_DIR to a folder that can be written to"));
  CHECK_FALSE(contains(chosen.err, "apt install"));
}

TEST_CASE("kernels that cannot be kept are compiled for each run, with a word") {
  if (!device_present()) return;
  const Folder folder;
  const std::string file = folder.file("a.toml", two_ends);
  const std::vector<std::string> run{"run", "-c", file, "-o", folder.path("out")};
  const Outcome kept = run_program(run);
  REQUIRE(kept.code == 0);
  CHECK_FALSE(contains(kept.err, "cannot be kept"));
  const std::string caches = folder.file("caches", "a file, not a folder");
  const Outcome again = run_program(run, {"XDG_CACHE_HOME=" + caches, "POCL_CACHE_DIR=" + folder.path("pocl")});
  CAPTURE(again.err);
  CHECK(again.code == 0);
  CHECK(contains(again.err, "compiled kernels cannot be kept in " + caches + "/wavetracer/programs (" + caches +
                                ": not a folder), so each start compiles them again"));
}
