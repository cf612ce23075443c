// SPDX-License-Identifier: Apache-2.0
// The drive that the tests of the program share: a vehicle crosses a room, ten frames a second.
#pragma once
#include <fmt/format.h>

#include <string>

#include "folders.hpp"

namespace wavetracer::test {

// Makes 10 * end_s + 1 frames from 0 to end_s; a lamp sends, a desk and the vehicle's roof receive.
inline std::string room_drive(double end_s, int shard_frames,
                              const std::string& scene = wavetracer::test::source_folder() +
                                                         "/configs/scenes/room/room.xml") {
  return fmt::format(R"(scene.file = "{}"
trace.rays = 2000
trace.max_depth = 2
output.shard_frames = {}
output.waypoints = 10
time.step_s = 0.1
[[transmitter]]
name = "lamp"
position_m = [1, 1, 2.5]
antenna = "isotropic"
[[receiver]]
name = "desk"
position_m = [7, 5, 1]
[[track]]
id = "truck"
type = "passenger"
waypoints = [[0, 3, 2, 0], [{}, 5, 4, 0]]
[[vehicle_type]]
name = "passenger"
length_m = 1.5
width_m = 0.8
height_m = 0.6
[[mount]]
name = "roof"
role = "receiver"
offset_m = [0, 0, 0.8]
)",
                     scene, shard_frames, end_s);
}

}  // namespace wavetracer::test
