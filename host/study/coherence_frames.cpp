// Records frame by frame and keeps three: the first, the one before and the one at hand.
// Rays of one launch index have one direction in all frames, so that the index pairs them.
#include "study/coherence_frames.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include "study/hit_recorder.hpp"
#include "study/run.hpp"
#include "study/scripts.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

constexpr double default_speed_m_s = 13.9;  // 50 km/h

// Six times the signed volume of a tetrahedron.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

bool crosses(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& a, const glm::dvec3& b,
             const glm::dvec3& c) {
  if (volume(a, b, c, from) * volume(a, b, c, to) >= 0) return false;
  const double ab = volume(from, to, a, b), bc = volume(from, to, b, c), ca = volume(from, to, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

}  // namespace

double Drive::moved_m(uint32_t frame) const { return time_s(frame) * glm::length(velocity_m_s); }

Drive plan_drive(const Config& config) {
  const RadioEnd& end = config.transmitters.front();
  Drive drive;
  drive.start_m = {end.position_m[0], end.position_m[1], end.position_m[2]};
  drive.velocity_m_s = {end.velocity_m_s[0], end.velocity_m_s[1], end.velocity_m_s[2]};
  if (glm::length(drive.velocity_m_s) == 0) drive.velocity_m_s = {default_speed_m_s, 0, 0};
  return drive;
}

void check_way(const Drive& drive, const Scene& scene, const std::string& end) {
  const glm::dvec3 from = drive.place_m(0) - scene.origin_m, to = drive.place_m(drive.frames - 1) - scene.origin_m;
  for (const auto& [a, b, c] : scene.triangles)
    if (crosses(from, to, scene.vertices[a], scene.vertices[b], scene.vertices[c]))
      throw ConfigError(
          fmt::format("transmitter \"{}\": its way of {:.1f} m leads through the scene; give it another "
                      "position_m or velocity_m_s (without one it drives along +x)",
                      end, drive.moved_m(drive.frames - 1)));
}

std::vector<FramePair> compare_pair(const FrameHits& a, const FrameHits& b, const std::string& against,
                                    uint32_t frame) {
  std::vector<FramePair> out;
  const std::vector<DepthCoherence> found = compare_frames(a, b);
  for (uint32_t i = 0; i < found.size(); ++i) {
    std::vector<glm::dvec3> points_a = hit_points(a[i]), points_b = hit_points(b[i]);
    const size_t count = std::min(points_a.size(), points_b.size());
    points_a.resize(count);
    points_b.resize(count);
    out.push_back({.against = against,
                   .frame = frame,
                   .depth = i + 1,
                   .found = found[i],
                   .by_place = correlate(points_a, points_b).total});
  }
  return out;
}

Columns<FramePair> frame_columns(const Drive& drive) {
  using P = FramePair;
  return {
      {"against", &P::against},
      {"frame", &P::frame},
      {"time_s", [drive](const P& p) { return drive.time_s(p.frame); }},
      {"moved_m", [drive](const P& p) { return drive.moved_m(p.frame); }},
      {"depth", &P::depth},
      {"pairs", [](const P& p) { return p.found.pairs; }},
      {"either", [](const P& p) { return p.found.either; }},
      {"both", [](const P& p) { return p.found.both; }},
      {"same_surface", [](const P& p) { return p.found.same_surface; }},
      {"same_sequence", [](const P& p) { return p.found.same_sequence; }},
      {"r_x", [](const P& p) { return p.found.points.component.x; }},
      {"r_y", [](const P& p) { return p.found.points.component.y; }},
      {"r_z", [](const P& p) { return p.found.points.component.z; }},
      {"total", [](const P& p) { return p.found.points.total; }},
      {"pooled", [](const P& p) { return p.found.points.pooled; }},
      {"by_place", &P::by_place},
  };
}

Findings measure(const FrameFigure& figure, const Experiment& experiment, const Request& request, const Host& host) {
  TraceConfig trace = request.config.trace;
  trace.rays = experiment_rays;
  trace.directions = "hilbert";
  Drive drive = plan_drive(request.config);
  drive.frames = figure.frames;
  TracedScene traced(request.config, request.device, {drive.place_m(0), drive.place_m(drive.frames - 1)});
  check_way(drive, traced.scene, request.config.transmitters.front().name);
  HitRecorder record(traced, trace);
  host.say(fmt::format("{}: {} frames of {} rays on {}", experiment.name, drive.frames, grouped(experiment_rays),
                       traced.device.name));
  Findings found{.device = traced.device, .planned = 1};
  std::vector<FramePair> rows;
  const FrameHits first = record(drive.place_m(0));
  FrameHits previous = first;
  for (uint32_t frame = 1; frame < drive.frames; ++frame) {
    if (host.interrupted()) return found;  // half a drive is no result
    FrameHits now = record(drive.place_m(frame));
    for (const auto& pairs : {compare_pair(first, now, "first", frame), compare_pair(previous, now, "previous", frame)})
      rows.insert(rows.end(), pairs.begin(), pairs.end());
    previous = std::move(now);
  }
  found.points = 1;
  const Columns<FramePair> columns = frame_columns(drive);
  found.table = encode(columns, rows);
  found.script = depth_script(
      {.name = experiment.name,
       .title = experiment.title + ", " + traced.device.name,
       .columns = names_of(columns),
       .max_depth = trace.max_depth,
       .x_label = "way driven (m)",
       .panels_a_row = 2,
       .panels = {
           {"correlation with the first frame", "moved_m", "total", "against", "first"},
           {"correlation with the frame before", "moved_m", "total", "against", "previous"},
           {"rays that hit the surface of the first frame", "moved_m", "same_surface", "against", "first"},
           {"rays that hit the surface of the frame before", "moved_m", "same_surface", "against", "previous"}}});
  found.words = frame_words(experiment, rows, drive, traced.device.name);
  found.notes = {
      fmt::format("drive: {} frames {:g} s apart, from ({:g}, {:g}, {:g}) m at ({:g}, {:g}, {:g}) m/s, in a scene that "
                  "stands still",
                  drive.frames, drive.step_s, drive.start_m.x, drive.start_m.y, drive.start_m.z, drive.velocity_m_s.x,
                  drive.velocity_m_s.y, drive.velocity_m_s.z),
      "total is equation 6.4 divided by the root of the number of components (three, less those that are constant); "
      "pooled is the coefficient of the points as vectors; by_place is total of points paired by their place in the "
      "lists of hits",
      "both is the share of rays that hit in both frames among those that hit in either; same_surface and "
      "same_sequence are shares of the rays that hit in both"};
  return found;
}

}  // namespace wavetracer::study
