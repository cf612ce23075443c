// SPDX-License-Identifier: Apache-2.0
// `wavetracer scene`: what info says of edges, and cities that it reads.
#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <sstream>
#include "folders.hpp"
#include "program.hpp"
#include "refused.hpp"

TEST_CASE("scene info --edges lists every edge that diffracts, and nothing else") {
  const Folder folder;
  const std::string scenes = wavetracer::test::source_folder() + "/tests/reference/scenes/";
  const Outcome wedge = run_program({"scene", "info", scenes + "simple_wedge/simple_wedge.xml", "--edges"});
  CHECK(wedge.code == 0);
  CHECK(wedge.err.empty());
  std::istringstream lines(wedge.out);
  std::string line;
  std::getline(lines, line);
  CHECK(contains(line, "inside, deg"));
  // Two plates of 30 x 30 m that meet at right angles along z: seven edges, six of them free.
  size_t count = 0, right_angles = 0;
  for (; std::getline(lines, line); ++count) {
    std::istringstream words(line);
    size_t edge = 0;
    std::array<double, 8> numbers{};
    words >> edge;
    for (double& number : numbers) words >> number;
    REQUIRE(words);
    CHECK(edge == count);
    CHECK(numbers[6] == 30);
    if (numbers[7] == 0) continue;
    ++right_angles;
    CHECK(numbers == std::array<double, 8>{0, 0, -15, 0, 0, 15, 30, 90});
    CHECK(line.ends_with("1 concrete, 0 concrete"));
  }
  CHECK(count == 7);
  CHECK(right_angles == 1);
  CHECK_FALSE(contains(wedge.out, "triangles"));
  CHECK(contains(run_program({"scene", "info", scenes + "simple_wedge/simple_wedge.xml"}).out,
                 "diffract   7 edges: 1 wedges, 6 free\n"));
}

TEST_CASE("scene info --edges of a room: its edges diffract nowhere but outside, and a wrong file is refused") {
  const Folder folder;
  const std::string box = wavetracer::test::source_folder() + "/tests/reference/scenes/box/box.xml";
  const Outcome room = run_program({"scene", "info", box, "--edges"});
  CHECK(room.code == 0);
  CHECK(std::ranges::count(room.out, '\n') == 1 + 12);  // the twelve outer edges, of 270 degrees
  check(run_program({"scene", "info", folder.path("absent.xml"), "--edges"}), 3, "absent.xml");
  check(run_program({"scene", "info", folder.file("a.ply", "no mesh"), "--edges"}), 3, "a.ply");
  check(run_program({"scene", "info", "--edges"}), 2, "file is required");
  check(run_program({"scene", "info", box, "--edge"}), 2, "--edge");
}

TEST_CASE("scene city writes what scene info reads") {
  const Folder folder;
  const Outcome made = run_program({"scene", "city", "-o", folder.path("city"), "--seed", "3", "--blocks", "2"});
  CHECK(made.code == 0);
  const Outcome info = run_program({"scene", "info", folder.path("city/city.xml")});
  CHECK(info.code == 0);
  CHECK(contains(info.out, "triangles"));
  CHECK(contains(info.out, "concrete"));
}
