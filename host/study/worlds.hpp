// The worlds of experiments whose frames move: the configuration's own drive, traffic in the built-in city, or a
// standing configuration whose transmitter is driven.
#pragma once
#include <cstdint>
#include <string>
#include "wavetracer/config.hpp"

namespace wavetracer::study {

// Between frames of the worlds that are made here: 100 frames per second.
constexpr double frame_step_s = 0.01;

// Whether the configuration has vehicles of its own, so that its frames are its own.
bool has_vehicles(const Config& config);

// The built-in city with 20 vehicles that receive, in a first frame and `frames` after it. drive: "fixed": its mast
// sends; "moving": three of the vehicles do instead; "spheres": the mast sends, and receivers are spheres that rays
// must hit; "thesis": both, as in the thesis, where all emitters move and receivers are spheres.
Config with_traffic(const Config& city, const std::string& drive, uint64_t frames);

// A configuration without vehicles, whose first transmitter rides on one without a body: straight on for a first frame
// and `frames` after it, as its velocity says, or at 13.9 m/s along +x. Nothing else sends. Throws ConfigError where
// there is no transmitter.
Config driven(const Config& standing, uint64_t frames);

// What an experiment on a drive measures in: with_traffic() of the built-in city, the configuration where it has
// vehicles, else driven().
Config moving_world(const Config& config, const std::string& drive_of_city, uint64_t frames);

}  // namespace wavetracer::study
