// SPDX-License-Identifier: Apache-2.0
// Records frame by frame and keeps three: the first, the previous and the current one.
// Rays of one launch index have one direction in all frames, so that the index pairs them.
#include "study/coherence_frames.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>
#include <random>
#include "study/hit_recorder.hpp"
#include "study/run.hpp"
#include "study/scripts.hpp"
#include "study/worlds.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

// Returns six times the signed volume of a tetrahedron.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

// A point in the plane of a triangle counts as in front of it, so that a way crosses it once.
bool crosses(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& a, const glm::dvec3& b,
             const glm::dvec3& c) {
  if ((volume(a, b, c, from) < 0) == (volume(a, b, c, to) < 0)) return false;
  const double ab = volume(from, to, a, b), bc = volume(from, to, b, c), ca = volume(from, to, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// At least two, since frames are compared.
uint32_t wanted_frames(const FrameFigure& figure, const Request& request) {
  const uint64_t frames = request.frames > 0 ? request.frames + 1 : figure.frames / (request.quick ? 5 : 1);
  return static_cast<uint32_t>(std::clamp<uint64_t>(frames, 2, UINT32_MAX));
}

Config frame_world(const FrameFigure& figure, const Config& config, uint32_t frames) {
  if (figure.traffic) return moving_world(config, "moving", frames - 1);
  return has_vehicles(config) ? config : driven(config, frames - 1);
}

// Describes the traffic around the transmitter. Vehicles without a body do not count.
std::string world_words(const TracedWorld& traced) {
  size_t bodies = 0;
  for (const Instance& instance : traced.world.fleet.instances)
    bodies += !traced.world.fleet.models[instance.model].triangles.empty();
  return bodies == 0 ? "a standing scene" : fmt::format("a scene with {} vehicles", bodies);
}

std::string drive_note(const Drive& drive, const TracedWorld& traced) {
  const glm::dvec3 &from = drive.place_m.front(), &to = drive.place_m.back();
  return fmt::format(
      "drive: {} frames {:g} s apart, of the transmitter \"{}\" from ({:.5g}, {:.5g}, {:.5g}) m to ({:.5g}, "
      "{:.5g}, {:.5g}) m, in {}",
      drive.frames(), drive.time_s(1), drive.name, from.x, from.y, from.z, to.x, to.y, to.z, world_words(traced));
}

}  // namespace

double Drive::moved_m(uint32_t frame) const {
  double way_m = 0;
  for (uint32_t k = 1; k <= frame; ++k) way_m += glm::distance(place_m[k - 1], place_m[k]);
  return way_m;
}

Drive plan_drive(const std::vector<RadioEnd>& transmitters, const std::function<WorldState(uint32_t)>& state,
                 uint64_t count, const glm::dvec3& origin_m, uint32_t frames, uint32_t least,
                 const std::string& where) {
  std::vector<Drive> running(transmitters.size());
  Drive longest;
  bool mounted = false;  // true if any transmitter is on a vehicle
  for (uint32_t frame = 0; frame < count && longest.frames() < frames; ++frame) {
    const WorldState world = state(frame);
    for (const EndState& end : world.transmitters) mounted = mounted || end.instance != no_instance;
    for (uint32_t i = 0; i < world.transmitters.size(); ++i) {
      const EndState& end = world.transmitters[i];
      if (mounted && end.instance == no_instance) continue;
      Drive& drive = running[i];
      if (!end.present) {
        drive = {};
        continue;
      }
      if (drive.at_s.empty()) drive = {.transmitter = i, .name = transmitters[i].name, .first = frame};
      drive.at_s.push_back(world.time_s);
      drive.place_m.push_back(origin_m + end.position_m);
      if (drive.frames() > longest.frames()) longest = drive;
    }
  }
  if (longest.frames() >= least) return longest;
  throw ConfigError(
      fmt::format("{}no transmitter is there in {} frames that follow each other ({} of them were looked at): "
                  "give its vehicle a longer trajectory, or more frames in [time]",
                  where, least, count));
}

void check_way(const Drive& drive, const Scene& scene) {
  for (uint32_t frame = 1; frame < drive.frames(); ++frame) {
    const glm::dvec3 from = drive.place_m[frame - 1] - scene.origin_m, to = drive.place_m[frame] - scene.origin_m;
    if (from == to) continue;
    for (const auto& [a, b, c] : scene.triangles)
      if (crosses(from, to, scene.vertices[a], scene.vertices[b], scene.vertices[c]))
        throw ConfigError(
            fmt::format("transmitter \"{}\": its way of {:.1f} m leads through the scene; "
                        "give it another position_m or velocity_m_s (without one it drives along +x)",
                        drive.name, drive.moved_m(drive.frames() - 1)));
  }
}

namespace {

// Lists of different lengths are paired as far as the shorter one goes.
double correlate_by_place(std::vector<glm::dvec3> a, std::vector<glm::dvec3> b) {
  const size_t count = std::min(a.size(), b.size());
  a.resize(count);
  b.resize(count);
  return correlate(a, b).total;
}

// Appends the depths of a frame one after the other, which makes them one depth of many rays.
FrameHits joined(const FrameHits& hits) {
  FrameHits out(1);
  for (const std::vector<Hit>& depth : hits) out.front().insert(out.front().end(), depth.begin(), depth.end());
  return out;
}

}  // namespace

std::vector<glm::dvec3> whole_output(const FrameHits& hits, const std::vector<uint32_t>& order) {
  std::vector<glm::dvec3> out;
  for (size_t k = 0; !hits.empty() && k < hits.front().size(); ++k)
    for (const std::vector<Hit>& depth : hits)
      if (const Hit& hit = depth[order.empty() ? k : order[k]]; is_hit(hit)) out.push_back(hit.point_m);
  return out;
}

// The standard does not say how std::shuffle draws, so that it is written out (R. Durstenfeld, CACM 7, 420, 1964).
std::vector<uint32_t> random_order(size_t rays) {
  std::vector<uint32_t> order(rays);
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937_64 random(1);
  for (size_t i = rays; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

std::vector<FramePair> compare_pair(const FrameHits& a, const FrameHits& b, const std::string& against,
                                    uint32_t frame) {
  std::vector<FramePair> out;
  const std::vector<DepthCoherence> found = compare_frames(a, b);
  for (uint32_t i = 0; i < found.size(); ++i)
    out.push_back({.against = against,
                   .frame = frame,
                   .depth = i + 1,
                   .found = found[i],
                   .by_place = correlate_by_place(hit_points(a[i]), hit_points(b[i]))});
  if (found.empty()) return out;
  const std::vector<uint32_t> unordered = random_order(a.front().size());
  out.push_back({.against = against,
                 .frame = frame,
                 .depth = 0,
                 .found = compare_frames(joined(a), joined(b)).front(),
                 .by_place = correlate_by_place(whole_output(a), whole_output(b)),
                 .by_place_unordered = correlate_by_place(whole_output(a, unordered), whole_output(b, unordered))});
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
      {"by_place_unordered", &P::by_place_unordered},
  };
}

Findings measure(const FrameFigure& figure, const Experiment& experiment, const Request& request, const Host& host) {
  TraceConfig trace = request.config.trace;
  trace.rays = experiment_rays;
  trace.directions = "hilbert";
  const uint32_t wanted = wanted_frames(figure, request);
  const Config config = frame_world(figure, request.config, wanted);
  std::shared_ptr<void> guard = host.guard();  // half of a drive is no result
  TracedWorld traced(config, request.device);
  const std::string where = config.file.empty() ? "" : config.file + ": ";
  if (traced.world.clock.frame_count() == 1)
    throw ConfigError(
        fmt::format("{}{} compares the frames of a drive, and there is one frame alone: give trajectories "
                    "that last longer, or another [time]",
                    where, experiment.name));
  const Drive drive = plan_drive(traced, wanted, 2, where + experiment.name + ": ");
  if (!has_vehicles(request.config)) check_way(drive, traced.scene);
  HitRecorder record(traced, trace);
  host.say(fmt::format("{}: {} frames of {} rays of \"{}\" on {}", experiment.name, drive.frames(),
                       grouped(experiment_rays), drive.name, traced.device.name));
  Findings found{.device = traced.device, .planned = 1};
  std::vector<FramePair> rows;
  const FrameHits first = record(drive.transmitter, drive.first);
  FrameHits previous = first;
  for (uint32_t frame = 1; frame < drive.frames(); ++frame) {
    if (host.interrupted()) return found;
    host.tell(experiment.name, frame, drive.frames(), "frames");
    FrameHits now = record(drive.transmitter, drive.first + frame);
    for (const auto& pairs : {compare_pair(first, now, "first", frame), compare_pair(previous, now, "previous", frame)})
      rows.insert(rows.end(), pairs.begin(), pairs.end());
    previous = std::move(now);
  }
  guard.reset();
  found.points = 1;
  found.figure = depth_figure(
      {.name = experiment.name,
       .title = experiment.title + ", " + traced.device.name,
       .max_depth = trace.max_depth,
       .x_label = "time (s)",
       .panels_a_row = 2,
       .panels = {{"correlation with the first frame", "time_s", "total", "against", "first"},
                  {"correlation with the frame before", "time_s", "total", "against", "previous"},
                  {"rays that hit the surface of the first frame", "time_s", "same_surface", "against", "first"},
                  {"rays that hit the surface of the frame before", "time_s", "same_surface", "against", "previous"}}},
      csv_of(frame_columns(drive), rows));
  found.words = frame_words(experiment, rows, drive, world_words(traced), traced.device.name);
  found.notes = {
      drive_note(drive, traced),
      "total is equation 6.4 divided by the root of the number of components (three, less those "
      "that are constant); "
      "pooled is the coefficient of the points as vectors; by_place is total of points paired by their place in "
      "the lists of hits; depth 0 is the whole output, whose list has all hits of a ray before those of the next one, along the curve of the launch (by_place) and "
      "with the rays in no order (by_place_unordered)",
      "both is the share of rays that hit in both frames among those that hit in either; "
      "same_surface and same_sequence are shares of the rays that hit in both"};
  return found;
}

}  // namespace wavetracer::study
