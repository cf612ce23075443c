// SPDX-License-Identifier: Apache-2.0
// The worlds of experiments whose frames move: the configuration's own drive, traffic in the built-in city, or a
// configuration without motion whose transmitter is driven.
#pragma once
#include <cstdint>
#include <string>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

// Time between frames of the worlds that are made here: 100 frames per second.
constexpr double frame_step_s = 0.01;

// Tells whether the configuration has vehicles of its own, so that its own frames are used.
bool has_vehicles(const Config& config);

// Returns the built-in city with 20 vehicles that receive, in a first frame and `frames` after it. drive: "fixed": its
// mast sends; "moving": three of the vehicles send instead; "spheres": the mast sends, and receivers are spheres that
// rays must hit; "thesis": both, as in the thesis, where all emitters move and receivers are spheres.
Config with_traffic(const Config& city, const std::string& drive, uint64_t frames);

// Returns a configuration without vehicles, whose first transmitter rides on a vehicle without a body: straight on for
// a first frame and `frames` after it, at its velocity, or at 13.9 m/s along +x. No other end sends. Throws ConfigError
// if there is no transmitter.
Config driven(const Config& standing, uint64_t frames);

// Returns the world of an experiment on a drive: with_traffic() of the built-in city, the configuration if it has
// vehicles, else driven().
Config moving_world(const Config& config, const std::string& drive_of_city, uint64_t frames);

}  // namespace wavetracer::study
