// SPDX-License-Identifier: Apache-2.0
// All of libwavetracer for C++20: configuration, simulation, paths, outputs. For C there is wavetracer/wavetracer.h.
// Link wavetracer::wavetracer of find_package(wavetracer); the headers need glm and nothing else.
//
// Units are SI and part of the names: _m, _s, _hz, _rad, _deg, _db. Results are arrays of equal length, with one
// element per path; declarations document the shapes. File coordinates are those of the scene file in metres; recentred
// ones are file coordinates minus Scene::origin_m.
//
// Errors are exceptions of error.hpp, each with the exit code of the command line: ConfigError, InputError,
// DeviceError, RuntimeError. If Simulation::run_frame throws one of them, drop that Simulation.
//
// Threads: only one thread at a time may use a Simulation; several may run in different threads. Results are plain
// data. Only one thread of the process at a time may call write_outputs().
#pragma once
#include "wavetracer/arrays.hpp"
#include "wavetracer/cache_entries.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/features.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/gradient.hpp"
#include "wavetracer/interaction_kinds.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/output.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/ray_waypoints.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/version.hpp"
#include "wavetracer/world_state.hpp"
