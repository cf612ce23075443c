// SPDX-License-Identifier: Apache-2.0
// Studies whose user wants to stop in the middle of a frame.
#include <functional>
#include <memory>

#include "accuracy/free_space.hpp"
#include "accuracy/study.hpp"
#include "app/program.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("a frame that is given up leaves the settings that are complete, and no samples") {
  if (!device_present()) return;
  const Folder folder;
  const SceneFile wall({Quad{{-5, 9, -2}, {20, 0, 0}, {0, 0, 8}}});
  const std::string file =
      folder.file("wall.toml", head(wall, "max_depth = 1\nrays = 1000\n") + antenna("mast", {1, 2, 1}) +
                                   "[[receiver]]\nname = \"phone\"\nposition_m = [6, 3, 1]\n");
  size_t said = 0, watched = 0, kept = 0;
  study::Host host{[&](const std::string&) { ++said; }, [] { return false; }};
  host.watch = [&](const FrameProgress&) { return ++watched, said < 4; };
  host.at_once = [&](const std::function<void()>& end) {
    if (end) end();
    return std::make_shared<int>(0);
  };
  const accuracy::Request request{
      .file = file, .sets = {}, .rays = {1000, 10000}, .device = "", .repeats = 1, .command_line = ""};
  // The program keeps the rows that there are where it would end.
  const accuracy::Study cut =
      accuracy::study(request, host, [&](const accuracy::Study& so_far) { kept = so_far.rows.size(); });
  CHECK(cut.rows.size() == 3);
  CHECK(cut.rows[0].measured());
  CHECK(kept == 3);
  CHECK(watched > 3);
  const accuracy::InputRequest inputs{.file = file, .sets = {}, .device = "", .frames = 1, .samples = 2, .errors = {}};
  const accuracy::InputStudy none = accuracy::study_inputs(inputs, host);
  CHECK(none.stopped);
  CHECK(none.rows.empty());
}
