// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about radars. The doc of each row gives the reason for its default; the default itself is the
// initialiser in radar_config.hpp.
#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "config/field_rows.hpp"

namespace wavetracer::config {
namespace {

std::vector<Field> end_fields() {
  const auto r = [](auto member) { return at(&Config::radars, member); };
  const std::string names =
      ", with * for any text and ? for any character; antennas of vehicles are called VEHICLE/MOUNT.";
  return {
      {.name = "name",
       .slot = r(&RadarConfig::name),
       .required = true,
       .doc = "Unique among radars; the name of its group in radar.h5, of letters, digits, - and _.",
       .example = "\"front\""},
      {.name = "kind",
       .slot = r(&RadarConfig::kind),
       .doc =
           "Which pairs of the transmitters and receivers below are radars. With \"monostatic\", a pair is a radar if "
           "both ends are on one vehicle, which links.same_vehicle must allow, or both are fixed. With "
           "\"bistatic\", a pair is a radar if its ends are on two vehicles, or if at least one end is fixed."},
      {.name = "transmitter", .slot = r(&RadarConfig::transmitter), .doc = "Names of the ends that send" + names},
      {.name = "receiver", .slot = r(&RadarConfig::receiver), .doc = "Names of the ends that receive" + names},
  };
}

std::vector<Field> wave_fields() {
  const auto r = [](auto member) { return at(&Config::radars, member); };
  return {
      {.name = "bandwidth_hz",
       .slot = r(&RadarConfig::bandwidth_hz),
       .unit = "Hz",
       .range = {0, 1e12, true},
       .doc = "By how much the frequency rises within a chirp, about the carrier as its middle. Ranges are told apart "
              "by c / (2 bandwidth_hz), 0.15 m for 1 GHz."},
      {.name = "chirp_s",
       .slot = r(&RadarConfig::chirp_s),
       .unit = "s",
       .range = {0, 3600, true},
       .doc = "The duration of a chirp; at least samples / bandwidth_hz, the delay up to which echoes are heard."},
      {.name = "interval_s",
       .slot = r(&RadarConfig::interval_s),
       .unit = "s",
       .range = {0, 3600, true},
       .doc = "The time from the beginning of a chirp to that of the next one. Not given: chirp_s.",
       .example = "25e-6"},
      {.name = "chirps",
       .slot = r(&RadarConfig::chirps),
       .range = {2, 65536},
       .doc = "Chirps of a frame, of each transmitting antenna: the Doppler shifts of the cube."},
      {.name = "samples",
       .slot = r(&RadarConfig::samples),
       .range = {2, 65536},
       .doc = "Complex samples of a chirp: the delays of the cube. Paths of samples / bandwidth_hz and more are left "
              "out, as by the filter of a receiver."},
      {.name = "turns",
       .slot = r(&RadarConfig::turns),
       .doc = "true: the antennas of the transmitter send chirps in turns. false: codes tell them apart without any "
              "error, and they send at the same time."},
      {.name = "power_dbm",
       .slot = r(&RadarConfig::power_dbm),
       .unit = "dBm",
       .range = {-200, 200},
       .doc = "The power that each transmitting antenna sends. Not given: radio.transmit_power_dbm, or else 10 dBm.",
       .example = "12.0"},
      {.name = "noise_figure_db",
       .slot = r(&RadarConfig::noise_figure_db),
       .unit = "dB",
       .range = {0, 100},
       .doc = "How far the noise of the receiver is above k T B at 290 K. Not given: a receiver without noise, which "
              "no device has; radars of cars have 10 to 15 dB.",
       .example = "12.0"},
      {.name = "seed",
       .slot = r(&RadarConfig::seed),
       .doc =
           "Only with noise_figure_db: of the noise, which also depends on the radar's name, the frame, its time and the "
           "link. Not given: 0.",
       .example = "1"},
  };
}

std::vector<Field> output_fields() {
  const auto r = [](auto member) { return at(&Config::radars, member); };
  return {
      {.name = "range_window",
       .slot = r(&RadarConfig::range_window),
       .doc =
           "The window over samples. With \"hann\", sidelobes fall fast; with \"none\", the main lobe is narrowest."},
      {.name = "doppler_window", .slot = r(&RadarConfig::doppler_window), .doc = "The window over chirps."},
      {.name = "direct",
       .slot = r(&RadarConfig::direct),
       .doc = "false: the direct path from the transmitter to the receiver is left out, as the filter of a radar "
              "does. With true, the direct path hides near targets."},
      {.name = "false_alarm",
       .slot = r(&RadarConfig::false_alarm),
       .range = {1e-300, 0.5},
       .doc =
           "Probability that a cell of noise of one pair of antennas is above the threshold of detections. It holds "
           "without windows: a window such as \"hann\" correlates neighbouring cells, so there are more false alarms."},
      {.name = "guard",
       .slot = r(&RadarConfig::guard),
       .unit = "cells",
       .range = {0, 1000},
       .doc = "Cells to each side of a cell that its threshold does not use; as many as a lobe is wide."},
      {.name = "training",
       .slot = r(&RadarConfig::training),
       .unit = "cells",
       .range = {1, 1000},
       .doc = "Cells to each side of a cell whose mean power its threshold uses, without those of guard."},
      {.name = "cube",
       .slot = r(&RadarConfig::cube),
       .doc = "true: the cubes of all antennas are written to radar.h5, too. false: maps, spectra and detections "
              "alone."},
  };
}

}  // namespace

Table radar_table() {
  Table out{.name = "radar",
            .doc =
                "A radar of linear chirps (FMCW), or several of one kind: range-Doppler cubes and detections of each "
                "frame, in radar.h5 and from `wavetracer serve` (docs/radar.md). Its echoes are the paths from its "
                "transmitters to its receivers.",
            .fields = end_fields(),
            .append = append<&Config::radars>,
            .count = count<&Config::radars>,
            .optional = true};
  std::ranges::move(wave_fields(), std::back_inserter(out.fields));
  std::ranges::move(output_fields(), std::back_inserter(out.fields));
  return out;
}

}  // namespace wavetracer::config
