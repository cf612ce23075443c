// What files leave out: order, segments, headings, centres, velocities. In this order; each once a track, order once.
// Assumes tracks of at least one sample, strictly increasing time, and scene coordinates but for the order.
#pragma once
#include <glm/vec3.hpp>
#include <optional>

#include "motion/trajectories.hpp"

namespace wavetracer {

// The unit vector a vehicle looks along.
glm::dvec3 heading(double yaw_rad, double pitch_rad);

// The median time between samples of a vehicle, 0 where no vehicle has two.
double median_step(const std::vector<Track>& tracks);

// Sorts the tracks, and sets the times and the step: the median without what doubles have added to it by rounding.
// There must be a track.
void set_order(Trajectories& trajectories);

// Cuts the track at gaps and at jumps, by the rule of read.hpp. step_s is that of the whole file; a track of at least
// four samples that is sampled more slowly throughout is measured by its own. Returns the time before the first cut.
std::optional<double> split_segments(Track& track, double step_s, double max_speed_m_s);

// Yaw and pitch where they are not given: the direction of motion, kept while the vehicle stands; zero where it never
// moves. Returns whether such a zero was needed.
bool complete_headings(Track& track);

// Positions from the centre of the front bumper to the centre of the footprint.
void shift_to_centre(Track& track, double length_m);

// Velocities: speed times heading; where there is no speed, the weighted mean of the velocities to both neighbours
// (the derivative of the parabola through the three), and zero where the vehicle stands before or after.
void complete_velocities(Track& track);

}  // namespace wavetracer
