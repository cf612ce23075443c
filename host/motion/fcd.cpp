// FCD as SUMO writes it ("FCDOutput" of its documentation, fcd_file.xsd).
// Assumes that a file has one run, its timesteps in order.
#include "motion/fcd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "motion/input_text.hpp"
#include "motion/track_builder.hpp"
#include "motion/track_motion.hpp"
#include "motion/xml_stream.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double degree = std::numbers::pi / 180;

constexpr std::string_view geo_advice =
    "the coordinates are longitude and latitude (--fcd-output.geo); run sumo without that option, so that it writes "
    "metres, or convert them to the scene's projection";

class FcdReader : private XmlStream {
 public:
  FcdReader(ByteStream& stream, const TrajectoryOptions& options)
      : XmlStream(stream, "an FCD output"), options_(options), tracks_(stream.file(), options) {}

  Trajectories read() {
    parse_all(
        "the file ends before </fcd-export>: let sumo finish, or cut off the last <timestep> and close the element");
    if (!has_timestep_) throw InputError(fmt::format("{}: the file has no <timestep>, so nothing would move", file()));
    refuse_degrees();
    if (skipped_ > 0) {
      tracks_.warn(fmt::format("{}: {} samples of persons and containers were left out; options can include them",
                               file(), skipped_));
    }
    if (riders_ > 0) {
      tracks_.warn(fmt::format("{}: {} samples of riders were left out: their vehicles carry them", file(), riders_));
    }
    if (decimals_ == 2) {
      tracks_.warn(
          fmt::format("{}: positions have 2 decimals, and an error of 5 mm is a phase error of 35 degrees at 5.9 GHz: "
                      "run sumo with --precision 6 where phases or Doppler matter",
                      file()));
    }
    return tracks_.finish(ReferencePoint::front_bumper);
  }

 private:
  enum class Level { document, root, timestep, vehicle };

  void end(std::string_view) override { --depth_; }

  void start(std::string_view name, Attributes attributes) override {
    switch (static_cast<Level>(std::min(depth_++, 3))) {
      case Level::document:
        if (name == "fcd-export") return;
        fail(fmt::format(
            "the root element is <{}>, but that of a trajectory file is <fcd-export>: run sumo with --fcd-output FILE",
            name));
      case Level::root:
        if (name != "timestep") fail(fmt::format("<{}> is outside of a <timestep>", name));
        return start_timestep(attributes);
      case Level::timestep:
        if (name == "vehicle") return add_sample(name, attributes, "", "DEFAULT_VEHTYPE");
        if (name == "person") return add_optional(options_.persons, name, attributes, "DEFAULT_PEDTYPE");
        if (name == "container") return add_optional(options_.containers, name, attributes, "DEFAULT_CONTAINERTYPE");
        if (unknown_.emplace(name).second) {
          tracks_.warn(fmt::format("{}:{}: <{}> is unknown and was skipped", file(), line(), name));
        }
        return;
      case Level::vehicle:
        if (name == "person" || name == "container") ++riders_;
    }
  }

  // SUMO begins a file with its configuration in a comment, options at their defaults left out.
  void comment(std::string_view text) override {
    constexpr std::string_view key = "<fcd-output.geo value=\"";
    const size_t at = text.find(key);
    if (at == text.npos) return;
    text.remove_prefix(at + key.size());
    const std::string value = lower_case(text.substr(0, text.find('"')));
    // The words for true of SUMO's options.
    if (value == "true" || value == "1" || value == "yes" || value == "on" || value == "t" || value == "x") {
      fail(geo_advice);
    }
  }

  void start_timestep(Attributes attributes) {
    const XML_Char* const text = find(attributes, "time");
    if (!text) fail("<timestep> has no attribute 'time'");
    const std::optional<double> time_s = seconds(text);
    if (!time_s) fail(fmt::format("<timestep>: time = '{}' is neither a number of seconds nor [d:]hh:mm:ss", text));
    if (has_timestep_ && *time_s <= time_s_) {
      fail(fmt::format(
          "time {}, from {} s in line {} to {} s; timesteps must be in order, and a file must contain only one run",
          *time_s == time_s_ ? "stands still" : "goes backwards", time_s_, timestep_line_, *time_s));
    }
    time_s_ = *time_s;
    timestep_line_ = line();
    has_timestep_ = true;
  }

  void add_optional(bool wanted, std::string_view name, Attributes attributes, std::string_view type) {
    if (!wanted) {
      ++skipped_;
      return;
    }
    add_sample(name, attributes, fmt::format("{}:", name), type);
  }

  void add_sample(std::string_view name, Attributes attributes, std::string_view prefix, std::string_view no_type) {
    const XML_Char* const id = find(attributes, "id");
    if (!id) fail(fmt::format("<{}> has no attribute 'id'", name));
    const std::string what = fmt::format("<{} id=\"{}\">", name, id);
    const auto optional_number = [&](std::string_view attribute, double otherwise) {
      const XML_Char* const text = find(attributes, attribute);
      if (!text) return otherwise;
      const std::optional<double> value = finite_number(text);
      if (!value) fail(fmt::format("{}: {} = '{}' is not a finite number", what, attribute, text));
      if (*value == sumo_invalid && attribute != "x" && attribute != "y") {
        fail(fmt::format("{}: {} = '{}' is what SUMO writes for an unknown value; leave this element out", what,
                         attribute, text));
      }
      return *value;
    };
    const auto coordinate = [&](std::string_view attribute) {
      const double value = optional_number(attribute, not_given);
      if (!std::isnan(value)) {
        decimals_ = std::max(decimals_, decimals(find(attributes, attribute)));
        return value;
      }
      fail(fmt::format("{} has no attribute '{}'; if --fcd-output.attributes was given to sumo, it must name x and y",
                       what, attribute));
    };
    const double x = coordinate("x"), y = coordinate("y");
    if (tracks_.off_network(x, y)) return;
    Sample sample;
    sample.time_s = time_s_;
    sample.position_m = {x, y, optional_number("z", 0)};
    sample.yaw_rad = std::remainder((90 - optional_number("angle", not_given)), 360.0) * degree;
    const double slope_deg = optional_number("slope", not_given);
    if (std::abs(slope_deg) >= 90) fail(fmt::format("{}: slope = {} is not within -90 to 90", what, slope_deg));
    sample.pitch_rad = slope_deg * degree;
    sample.speed_m_s = optional_number("speed", not_given);
    const XML_Char* const type = find(attributes, "type");
    tracks_.add(fmt::format("{}{}", prefix, id), type ? std::string_view(type) : no_type, sample, line(), what);
  }

  static size_t decimals(std::string_view text) {
    const size_t point = text.find('.');
    return point == text.npos ? 0 : text.size() - point - 1;
  }

  // A file may have lost the comment that tells its options. Degrees betray themselves: all within the globe, and
  // vehicles that drive by their speeds but hardly move: a metre is 1e-5 degrees, and 1e-4 of longitude at 85 degrees.
  void refuse_degrees() const {
    for (const Track& track : tracks_.tracks()) {
      for (const Sample& s : track.samples) {
        if (std::abs(s.position_m.x) > 180 || std::abs(s.position_m.y) > 90) return;
      }
    }
    const double longest_s = 1.5 * median_step(tracks_.tracks());  // not across gaps
    double driven_m = 0, moved = 0;
    for (const Track& track : tracks_.tracks()) {
      for (size_t k = 1; k < track.samples.size(); ++k) {
        const Sample &a = track.samples[k - 1], &b = track.samples[k];
        const double least_m_s = std::min(std::abs(a.speed_m_s), std::abs(b.speed_m_s));
        if (!(least_m_s > 0) || b.time_s - a.time_s > longest_s) continue;
        driven_m += least_m_s * (b.time_s - a.time_s);
        moved += std::hypot(b.position_m.x - a.position_m.x, b.position_m.y - a.position_m.y);
      }
    }
    if (driven_m > 1 && moved < 1e-3 * driven_m) throw InputError(fmt::format("{}: {}", file(), geo_advice));
  }

  const TrajectoryOptions& options_;
  TrackBuilder tracks_;
  int depth_ = 0;  // of open elements
  bool has_timestep_ = false;
  double time_s_ = 0;
  uint64_t timestep_line_ = 0;
  size_t decimals_ = 0;  // the most of any coordinate
  uint64_t skipped_ = 0, riders_ = 0;
  std::set<std::string, std::less<>> unknown_;
};

}  // namespace

Trajectories read_fcd(ByteStream& stream, const TrajectoryOptions& options) {
  return FcdReader(stream, options).read();
}

}  // namespace wavetracer
