// SPDX-License-Identifier: Apache-2.0
// Reads GPX (https://www.topografix.com/GPX/1/1/gpx.xsd): <trk> of <trkseg> of <trkpt lat lon> with a <time>.
// Points of a track must be in order; routes and single waypoints have no times and are skipped.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <set>

#include "motion/input_text.hpp"
#include "motion/track_builder.hpp"
#include "motion/xml_stream.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t longest_text = 4096;  // longest name or time

struct TrackPoint {
  std::optional<UtcTime> time;
  glm::dvec3 position;  // longitude and latitude in degrees, height above the ground
  uint64_t line;
};

struct GpxTrack {
  std::string name;
  std::vector<TrackPoint> points;
};

class GpxReader : private XmlStream {
 public:
  GpxReader(ByteStream& stream, const TrajectoryOptions& options)
      : XmlStream(stream, "a GPX file"), tracks_(stream.file(), options) {}

  Trajectories read() {
    parse_all("the file ends before </gpx>: save it again from the program that wrote it");
    std::optional<UtcTime> first;
    for (const GpxTrack& track : found_)
      if (!track.points.empty() && !(first && *first <= *track.points.front().time)) first = track.points.front().time;
    if (!first)
      throw InputError(
          fmt::format("{}: the file has no <trkpt>, so nothing would move; routes (<rte>) and waypoints (<wpt>) have "
                      "no times and are not read",
                      file()));
    tracks_.in_degrees();
    for (const GpxTrack& track : found_) add(track, *first);
    if (repeated_ > 0)
      tracks_.warn(fmt::format("{}: {} points have the time of the point before and were left out", file(), repeated_));
    if (elevations_ > 0)
      tracks_.warn(
          fmt::format("{}: the elevations of {} points are not used: vehicles stand on the ground of the scene", file(),
                      elevations_));
    return tracks_.finish(ReferencePoint::centre);
  }

 private:
  static std::string_view local(std::string_view name) { return name.substr(name.find(':') + 1); }
  bool inside(std::string_view parent) const { return open_.size() > 1 && open_[open_.size() - 2] == parent; }

  void start(std::string_view qualified, Attributes attributes) override {
    constexpr size_t deepest = 100;
    const std::string_view name = local(qualified);
    if (open_.empty() && name != "gpx") fail(fmt::format("the root element is <{}>, but that of GPX is <gpx>", name));
    if (open_.size() == deepest) fail("elements are nested more than 100 deep; this is not a GPX file");
    open_.emplace_back(name);
    text_.clear();
    if (name == "trk" && inside("gpx")) {
      found_.emplace_back();
    } else if (name == "trkpt" && inside("trkseg")) {
      if (found_.empty()) fail("<trkpt> is outside of a <trk>");
      point_ = {{}, {degrees(attributes, "lon", 180), degrees(attributes, "lat", 90), 0}, line()};
    }
  }

  double degrees(Attributes attributes, std::string_view name, double most) const {
    const XML_Char* const text = find(attributes, name);
    if (!text) fail(fmt::format("<trkpt> has no attribute '{}'", name));
    const std::optional<double> value = finite_number(text);
    if (!value || std::abs(*value) > most)
      fail(fmt::format("<trkpt>: {} = '{}' is not a number of degrees from -{:g} to {:g}", name, text, most, most));
    return *value;
  }

  void text(std::string_view more) override {
    if (text_.size() < longest_text) text_ += more.substr(0, longest_text - text_.size());
  }

  void end(std::string_view) override {
    const std::string name = open_.back();
    if (name == "name" && inside("trk") && !found_.empty()) {
      found_.back().name = trimmed(text_);
    } else if (name == "time" && inside("trkpt")) {
      point_.time = utc_time(trimmed(text_));
      if (!point_.time)
        fail(fmt::format("<time> '{}' is not a time such as 2026-11-24T10:00:00Z", trimmed(text_).substr(0, 60)));
    } else if (name == "ele" && inside("trkpt")) {
      ++elevations_;
    } else if (name == "trkpt" && inside("trkseg")) {
      end_point();
    }
    open_.pop_back();
  }

  void end_point() {
    if (!point_.time)
      fail(
          "<trkpt> has no <time>; a track that was planned and not recorded has none: use [[track]] with "
          "waypoints_wgs84 instead");
    std::vector<TrackPoint>& points = found_.back().points;
    if (!points.empty() && points.back().time == point_.time)
      ++repeated_;
    else
      points.push_back(point_);
  }

  void add(const GpxTrack& track, const UtcTime& first) {
    std::string id = track.name.empty() ? "track" : track.name;
    for (int k = 2; !ids_.insert(id).second; ++k)
      id = fmt::format("{} {}", track.name.empty() ? "track" : track.name, k);
    for (const TrackPoint& point : track.points) {
      Sample sample;
      sample.time_s = point.time->since_s(first);
      sample.position_m = point.position;
      tracks_.add(id, "passenger", sample, point.line, fmt::format("track '{}'", id));
    }
  }

  TrackBuilder tracks_;
  std::vector<GpxTrack> found_;
  std::vector<std::string> open_;  // names of elements, from the root
  std::string text_;               // text of the innermost element
  TrackPoint point_{};
  std::set<std::string> ids_;
  uint64_t repeated_ = 0, elevations_ = 0;
};

// Takes a whole number of this many digits from the front of the text.
std::optional<int> take_digits(std::string_view& text, size_t count) {
  int value = 0;
  if (text.size() < count) return {};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + count, value);
  if (error != std::errc() || stop != text.data() + count || value < 0) return {};
  text.remove_prefix(count);
  return value;
}

bool take_letter(std::string_view& text, char letter) {
  if (text.empty() || text.front() != letter) return false;
  text.remove_prefix(1);
  return true;
}

// Parses "Z", "+01:00" or nothing, up to the end of the text; returns seconds east of Greenwich.
std::optional<int> zone_seconds(std::string_view text) {
  if (text.empty() || text == "Z") return 0;
  const int sign = text.front() == '-' ? -1 : text.front() == '+' ? 1 : 0;
  text.remove_prefix(1);
  const auto hours = take_digits(text, 2);
  if (sign == 0 || !hours || !take_letter(text, ':')) return {};
  const auto minutes = take_digits(text, 2);
  if (!minutes || !text.empty() || *hours > 14 || *minutes > 59) return {};
  return sign * (*hours * 3600 + *minutes * 60);
}

}  // namespace

std::optional<UtcTime> utc_time(std::string_view text) {
  std::array<int, 6> parts{};  // year, month, day, hour, minute, second
  constexpr std::array<char, 6> after = {'-', '-', 'T', ':', ':', 0};
  for (size_t k = 0; k < parts.size(); ++k) {
    const auto value = take_digits(text, k == 0 ? 4 : 2);
    if (!value || (after[k] != 0 && !take_letter(text, after[k]))) return {};
    parts[k] = *value;
  }
  const auto [year, month, day, hour, minute, second] = parts;
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || hour > 23 || minute > 59 || second > 60) return {};
  double fraction = 0;
  if (!text.empty() && text.front() == '.') {
    const size_t end = std::min(text.find_first_not_of("0123456789", 1), text.size());
    const std::optional<double> value = end > 1 ? finite_number(text.substr(0, end)) : std::nullopt;
    if (!value) return {};
    fraction = *value;
    text.remove_prefix(end);
  }
  const std::optional<int> zone_s = zone_seconds(text);
  if (!zone_s) return {};
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return UtcTime{86400 * int64_t{days} + (hour * 3600 + minute * 60 + second - *zone_s), fraction};
}

Trajectories read_gpx(ByteStream& stream, const TrajectoryOptions& options) {
  return GpxReader(stream, options).read();
}

}  // namespace wavetracer
