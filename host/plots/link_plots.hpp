// SPDX-License-Identifier: Apache-2.0
// Makes the figures of links, one function each, from the result of link_series().
// Each series must have at least one path.
#pragma once
#include "plots/figure.hpp"
#include "plots/link_series.hpp"

namespace wavetracer::plots {

// Plots the path gain of the links against time, with dots where the line of sight is free.
Figure gain_figure(const SavedRun& run, const LinkSeries& series, const RadioConfig& radio);
// Plots gain against delay of the paths of one frame, coloured by kind.
Figure delay_figure(const SavedRun& run, const LinkSeries& series);
// Plots power by delay and time as an image: paths in one cell add their powers.
Figure delay_time_figure(const SavedRun& run, const LinkSeries& series);
// Plots paths of one frame by delay and Doppler shift, coloured by gain.
Figure doppler_figure(const SavedRun& run, const LinkSeries& series);
// Plots paths of one frame by azimuth and elevation, at the transmitter and at the receiver, coloured by gain.
Figure angle_figure(const SavedRun& run, const LinkSeries& series);

}  // namespace wavetracer::plots
