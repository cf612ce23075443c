// SPDX-License-Identifier: Apache-2.0
// First configuration files of `wavetracer init --minimal`, `--sumo` and `--coverage`: short ones, to be changed. Other
// keys have their defaults; tests run the files unchanged.
#pragma once

namespace wavetracer::app {

inline constexpr const char* minimal_config = R"(# A transmitter and a receiver in a generated city.
# `wavetracer run -c THIS.toml`; `wavetracer help KEY` explains a key, `wavetracer init` prints all of them.

[scene]
generate = "--seed 1 --blocks 6x6"  # or file = "city.xml"; `wavetracer convert` makes one of a map

[[transmitter]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]

[[receiver]]
name = "car"
position_m = [60.0, -3.0, 1.5]
)";

inline constexpr const char* sumo_config = R"(# Channels between the vehicles of a drive of SUMO. Make both files first:
#   wavetracer convert town.osm --net town.net.xml -o town           # or town.poly.xml: town/city.xml
#   sumo -c town.sumocfg --step-length 0.1 --fcd-output drive.fcd.xml --precision 6

[scene]
file = "town/city.xml"
streets = "town.net.xml"  # for the viewer only, which draws these streets

[trajectories]
file = "drive.fcd.xml"

[radio]
frequency_hz = 5.9e9

# An antenna above the middle of every roof. Add a table for higher vehicles, such as on = "truck".
[[mount]]
name = "roof"
on = "*"                    # ids or types of vehicles
role = "both"               # sends and receives
offset_m = [0.0, 0.0, 1.6]  # ahead, left, up from the middle of the vehicle, on the ground

[links]
max_distance_m = 300  # pairs farther apart are not computed
)";

inline constexpr const char* coverage_config = R"(# A coverage map of one antenna: receivers on a grid.
# `wavetracer run -c THIS.toml -o out`, then `wavetracer plot out --what coverage`.

[scene]
generate = "--seed 1 --blocks 6x6"  # or file = "city.xml"

[[transmitter]]
name = "rsu"
position_m = [8.0, 8.0, 6.0]

[[receiver_grid]]
name = "street"
x_min_m = -150.0
x_max_m = 150.0
y_min_m = -150.0
y_max_m = 150.0
step_m = 5.0    # 60 x 60 receivers
height_m = 1.5
)";

}  // namespace wavetracer::app
