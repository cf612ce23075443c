// All of libwavetracer for C++20: configuration, simulation, paths, outputs. For C there is wavetracer/wavetracer.h.
// Link wavetracer::wavetracer of find_package(wavetracer); the headers need glm and nothing else.
//
// Units are SI and stand in the names: _m, _s, _hz, _rad, _deg, _db. Rows of results are arrays of equal length, one
// element a path; shapes stand where each is declared. File coordinates are those of the scene file in metres;
// recentred ones are file coordinates minus Scene::origin_m.
//
// Errors are exceptions of error.hpp, each with the exit code of the command line: ConfigError, InputError,
// DeviceError, RuntimeError. After one of them was thrown by Simulation::run_frame, drop that Simulation.
//
// Threads: a Simulation belongs to one thread at a time, several of them may run in threads of their own. What they
// return is plain data. write_outputs() is for one thread of the process at a time.
#pragma once
#include "wavetracer/config.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/features.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/interaction_kinds.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/output.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/ray_waypoints.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/version.hpp"
#include "wavetracer/world_state.hpp"
