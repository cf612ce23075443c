// SPDX-License-Identifier: Apache-2.0
// Reads FCD as SUMO writes it ("FCDOutput" of its documentation, fcd_file.xsd).
// Texts are not trusted: every number is checked.
#include "motion/fcd_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/input_text.hpp"
#include "motion/track_motion.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double fcd_degree = std::numbers::pi / 180;

constexpr std::string_view geo_advice =
    "the coordinates are longitude and latitude (--fcd-output.geo), which need a georeference.json beside "
    "the scene file (docs/formats.md has its form; `wavetracer convert MAP -o FOLDER` writes one); "
    "or run sumo without that option, so that it writes metres";

size_t decimals(std::string_view text) {
  const size_t point = text.find('.');
  return point == text.npos ? 0 : text.size() - point - 1;
}

}  // namespace

void FcdSamples::start(std::string_view text, uint64_t line) {
  const std::optional<double> time_s = seconds(text);
  const auto fail = [&](const std::string& what) { fail_at(tracks_.file(), line, what); };
  if (!time_s) fail(fmt::format("<timestep>: time = '{}' is neither a number of seconds nor [d:]hh:mm:ss", text));
  if (started_ && *time_s <= time_s_)
    fail(fmt::format(
        "time {}, from {} s in line {} to {} s; timesteps must be in order, and a file must contain only one run",
        *time_s == time_s_ ? "stands still" : "goes backwards", time_s_, timestep_line_, *time_s));
  time_s_ = *time_s;
  timestep_line_ = line;
  started_ = true;
}

void FcdSamples::add(const FcdKind& kind, std::string_view id, std::string_view what, uint64_t line, const Find& find) {
  if (kind.wanted && !(options_.*kind.wanted)) {
    ++skipped_;
    return;
  }
  const auto fail = [&](const std::string& why) { fail_at(tracks_.file(), line, fmt::format("{}{}", what, why)); };
  const auto optional_number = [&](std::string_view attribute, double otherwise) {
    const std::optional<std::string_view> text = find(attribute);
    if (!text) return otherwise;
    const std::optional<double> value = finite_number(*text);
    if (!value) fail(fmt::format(": {} = '{}' is not a finite number", attribute, *text));
    if (*value == sumo_invalid && attribute != "x" && attribute != "y")
      fail(fmt::format(": {} = '{}' is what SUMO writes for an unknown value; leave this element out", attribute,
                       *text));
    return *value;
  };
  const auto coordinate = [&](std::string_view attribute) {
    const double value = optional_number(attribute, not_given);
    if (std::isnan(value))
      fail(fmt::format(" has no attribute '{}'; if --fcd-output.attributes was given to sumo, it must name x and y",
                       attribute));
    decimals_ = std::max(decimals_, decimals(*find(attribute)));
    return value;
  };
  const double x = coordinate("x"), y = coordinate("y");
  if (tracks_.off_network(x, y)) return;
  if (degrees_ && (std::abs(x) > 180 || std::abs(y) > 90))
    fail(
        fmt::format(": longitude {} and latitude {} are no place on the earth, but the file says --fcd-output.geo; "
                    "where the network has no projection, sumo writes metres all the same: run it without that option",
                    x, y));
  has_z_ = has_z_ || find("z");
  Sample sample;
  sample.time_s = time_s_;
  sample.position_m = {x, y, optional_number("z", 0)};
  sample.yaw_rad = std::remainder((90 - optional_number("angle", not_given)), 360.0) * fcd_degree;
  const double slope_deg = optional_number("slope", not_given);
  if (std::abs(slope_deg) >= 90) fail(fmt::format(": slope = {} is not within -90 to 90", slope_deg));
  sample.pitch_rad = slope_deg * fcd_degree;
  sample.speed_m_s = optional_number("speed", not_given);
  tracks_.add(fmt::format("{}{}", kind.id_prefix, id), find("type").value_or(kind.default_type), sample, line, what);
}

void FcdSamples::in_degrees(uint64_t line) {
  if (!options_.from_degrees) fail_at(tracks_.file(), line, geo_advice);
  degrees_ = true;
}

// Compares the distances that vehicles drive by their speeds with the changes of their coordinates.
FcdSamples::Motion FcdSamples::motion() const {
  const double longest_s = 1.5 * median_step(tracks_.tracks());  // gaps are left out
  Motion out;
  for (const Track& track : tracks_.tracks()) {
    for (size_t k = 1; k < track.samples.size(); ++k) {
      const Sample &a = track.samples[k - 1], &b = track.samples[k];
      const double least_m_s = std::min(std::abs(a.speed_m_s), std::abs(b.speed_m_s));
      if (!(least_m_s > 0) || b.time_s - a.time_s > longest_s) continue;
      out.driven_m += least_m_s * (b.time_s - a.time_s);
      out.moved += std::hypot(b.position_m.x - a.position_m.x, b.position_m.y - a.position_m.y);
    }
  }
  return out;
}

// A file may not say which of SUMO's options were used, and may be wrong: without a projection SUMO writes metres
// although degrees were asked for. So the data decide. Coordinates are degrees if all are on the globe, and vehicles
// drive by their speeds but hardly move: a metre is 1e-5 degrees, and 1e-4 of longitude at a latitude of 85 degrees.
bool FcdSamples::is_in_degrees() const {
  const Motion motion = this->motion();
  const bool drives = motion.driven_m > 1;
  if (degrees_ && drives && motion.moved > 0.1 * motion.driven_m)
    throw InputError(fmt::format(
        "{}: the file says --fcd-output.geo, but its vehicles move as if x and y were metres, which SUMO writes "
        "where the network has no projection: run sumo without that option",
        tracks_.file()));
  if (degrees_) return true;
  for (const Track& track : tracks_.tracks()) {
    for (const Sample& s : track.samples) {
      if (std::abs(s.position_m.x) > 180 || std::abs(s.position_m.y) > 90) return false;
    }
  }
  return drives && motion.moved < 1e-3 * motion.driven_m;
}

// Networks without heights have no z: their vehicles are on the ground, at whatever height that is.
void FcdSamples::place_degrees() {
  constexpr size_t enough = 8;  // half a millimetre
  if (!options_.from_degrees) throw InputError(fmt::format("{}: {}", tracks_.file(), geo_advice));
  if (!degrees_)
    tracks_.warn(
        fmt::format("{}: x and y are taken as longitude and latitude (--fcd-output.geo): "
                    "as metres they would hardly move, whatever their speeds are",
                    tracks_.file()));
  if (decimals_ < enough)
    tracks_.warn(
        fmt::format("{}: positions have {} decimals of a degree, and so an error of {:.2g} m: "
                    "run sumo with --precision.geo 9 where phases or Doppler matter",
                    tracks_.file(), decimals_, 111195 * 0.5 * std::pow(10, -static_cast<double>(decimals_))));
  tracks_.in_degrees(!has_z_);
}

Trajectories FcdSamples::finish() {
  const std::string& file = tracks_.file();
  const bool degrees = is_in_degrees();
  if (degrees) place_degrees();
  if (skipped_ > 0) {
    tracks_.warn(fmt::format("{}: {} samples of persons and containers were left out; options can include them", file,
                             skipped_));
  }
  if (riders_ > 0) {
    tracks_.warn(fmt::format("{}: {} samples of riders were left out: their vehicles carry them", file, riders_));
  }
  if (!degrees && decimals_ == 2) {
    tracks_.warn(
        fmt::format("{}: positions have 2 decimals, and an error of 5 mm is a phase error of 35 degrees at 5.9 GHz: "
                    "run sumo with --precision 6 where phases or Doppler matter",
                    file));
  }
  return tracks_.finish(ReferencePoint::front_bumper);
}

}  // namespace wavetracer
