// SPDX-License-Identifier: Apache-2.0
// Births and deaths of paths in a drive, by halving the time between its frames.
#pragma once
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "wavetracer/simulation.hpp"

namespace wavetracer {

// An interaction of a path: its kind, and the surface or edge, numbered in the static scene or in the instance's model.
struct TouchedThing {
  uint8_t interaction = 0;
  uint32_t thing = 0, instance = no_instance;
  auto operator<=>(const TouchedThing&) const = default;
};
// A path by what it touches, from the transmitter on; it stays the same one while everything moves.
using Touched = std::vector<TouchedThing>;

// The paths of links at one time, each with its lifetime in metres (Paths::lifetime_m).
using LivingPaths = std::map<Touched, double>;
using LinksAtTime = std::map<Link, LivingPaths>;

struct PathEvent {
  double time_s;
  Link link;
  bool birth;  // false: a death
  Touched path;
};

struct EventChoice {
  double precision = 1e-3;   // relative to a step, of the times of events
  uint32_t parts = 1;        // parts of a step at whose ends all links are computed
  double finest = 1.0 / 32;  // the shortest part of a step that is cut because lifetimes are shorter
};

struct EventList {
  std::vector<PathEvent> events;  // by time, then by link, then by path
  uint64_t instants = 0;          // times that were computed, for all links or some
  // Pieces of time of at most choice.finest of a step at both of whose ends a path is there, whose lifetimes do not
  // cover the piece: it may have died and come back.
  uint64_t unsure = 0;
  uint64_t unbounded = 0;  // the same for paths whose lifetime is 0, so that nothing is known; these are not cut
};

// The drive as it is asked.
struct EventDrive {
  // Gives the paths of these links at a time; without a list, those of all links. Links without paths may be left out.
  std::function<LinksAtTime(double time_s, const std::vector<Link>* only)> paths;
  std::function<double(double from_s, double to_s)> motion_m;  // as Simulation::motion_m()
};

// Finds the births and deaths between these times, which are those of frames. Each step between two of them is cut into
// choice.parts, and each part is halved, for the links that need it: down to choice.precision where the paths at its
// ends differ, and down to choice.finest where a path is at both ends and its lifetimes are shorter than the motion.
// An event's time is the middle of what is left. A path that is there at one of the times that are computed has all of
// its births and deaths, but for those in pieces that are counted as unsure or unbounded. So every path is found that
// lives for a part of a step. A path that is born and dies between two times that are computed is not found.
EventList find_events(const EventDrive& drive, const std::vector<double>& times_s, const EventChoice& choice);

// The drive of a simulation whose frames have lifetimes.
EventDrive drive_of(Simulation& simulation);

}  // namespace wavetracer
