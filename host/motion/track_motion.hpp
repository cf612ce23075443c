// SPDX-License-Identifier: Apache-2.0
// Completes what files leave out: order, segments, headings, centres, velocities. The functions must be called in this
// order, once per track, and set_order() once. Tracks have at least one sample and strictly increasing times; all but
// set_order() need scene coordinates.
#pragma once
#include <glm/vec3.hpp>
#include <optional>

#include "motion/trajectories.hpp"

namespace wavetracer {

// Returns the unit vector of the vehicle's heading.
glm::dvec3 heading(double yaw_rad, double pitch_rad);

// Returns the median time between samples of a vehicle, 0 if no vehicle has two.
double median_step(const std::vector<Track>& tracks);

// Sorts the tracks, and sets the times and the step, which is the median without the rounding of doubles. There must be
// a track.
void set_order(Trajectories& trajectories);

// Cuts the track at gaps and at jumps, by the rule of read.hpp. step_s: of the whole file; a track of at least four
// samples that is sampled more slowly throughout uses its own step. frames_s: the times of all frames of the file, in
// order, if they are known: then a gap is a frame without the vehicle, however long a step takes. Returns the time
// before the first cut.
std::optional<double> split_segments(Track& track, double step_s, double max_speed_m_s,
                                     const std::vector<double>& frames_s = {});

// Fills missing yaw and pitch with the direction of motion, kept while the vehicle stands; zero if it never moves.
// Returns whether such a zero was needed.
bool complete_headings(Track& track);

// Moves positions from the centre of the front bumper to the centre of the footprint.
void shift_to_centre(Track& track, double length_m);

// Turns `arm` (ahead, left, up of a vehicle with this yaw and pitch, nose up) into the axes of the scene, as from the
// reference point of another program to the centre of the footprint. Roll is ignored.
glm::dvec3 turned_arm(const glm::dvec3& arm, double yaw_rad, double pitch_rad);

// Tells whether a file's length, width and height, in metres, can be those of a vehicle.
bool is_size(const glm::dvec3& size_m);

// Computes velocities: speed times heading; without a speed, the weighted mean of the velocities to both neighbours
// (the derivative of the parabola through the three), and zero if the vehicle stands before or after.
void complete_velocities(Track& track);

}  // namespace wavetracer
