// SPDX-License-Identifier: Apache-2.0
// Runs on a device that has no memory for the lists of a frame (Gate::at_buffers).
#include <doctest/doctest.h>
#include "folders.hpp"
#include "gate.hpp"
#include "program.hpp"

TEST_CASE("without memory for the lists of all receivers the frame comes in batches, and is the same") {
  if (!device_present()) return;
  const Folder folder;
  std::string text =
      "scene.generate = \"--blocks 2\"\ntrace.rays = 20000\ntrace.max_depth = 4\n"
      "[[transmitter]]\nname = \"mast\"\nposition_m = [0, 0, 6]\n";
  for (int i = 0; i < 6000; ++i)
    text += "[[receiver]]\nname = \"at " + std::to_string(i) + "\"\nposition_m = [" + std::to_string(50 - i / 120) +
            ", " + std::to_string(0.025 * (i % 120)) + ", 1.5]\n";
  const std::string file = folder.file("a.toml", text);
  const Gate gate;
  const auto run = [&](size_t largest) {
    return run_program({"run", "-c", file, "-o", folder.path("out")}, gate.at_buffers(largest));
  };
  const Outcome all = run(size_t{1} << 40);
  REQUIRE(all.code == 0);
  CHECK_FALSE(contains(all.err, "did not fit into"));
  const std::string links = contents(folder.path("out/links.csv"));
  for (const size_t largest : {size_t{1} << 22, size_t{1} << 21}) {  // less than the points of all paths need
    CAPTURE(largest);
    const Outcome batches = run(largest);
    CAPTURE(batches.err);
    CHECK(batches.code == 0);
    CHECK(contains(batches.err, "did not fit into"));
    CHECK(contents(folder.path("out/links.csv")) == links);
  }
  const Outcome shared = run_program({"run", "-c", file, "-o", folder.path("out"), "--set", "trace.diffraction=false"},
                                     gate.at_buffers(size_t{1} << 21));
  CHECK(contains(shared.err, "rays are launched for the first of them, and the others use what these find"));
  const Outcome none = run(size_t{1} << 20);  // less than the set of sequences needs at first
  CHECK(none.code == 4);
  CHECK(contains(none.err, "CL_MEM_OBJECT_ALLOCATION_FAILURE"));
}
