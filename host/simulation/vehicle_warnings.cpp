// SPDX-License-Identifier: Apache-2.0
// Compares vehicles with the static scene, at a number of places that does not grow with the drive. Trajectories are
// recentred, with positions on the ground.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/times.hpp"
#include "motion/pose.hpp"
#include "simulation/place_warnings.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t most_places = 20000;  // for all vehicles: below 0.2 s
constexpr double step_m = 1;             // vehicles may be this much above the ground
constexpr double sunk_m = 0.5;           // or this much below it: kerbs, ramps and rounding of maps are less

enum VehicleFault { through, sunk, floating, beside, vehicle_faults };
constexpr std::array<const char*, vehicle_faults> fault_words = {"drive through closed bodies", "are below the ground",
                                                                 "are above the ground", "drive off the ground"};
constexpr const char* belong = "check trajectories.offset_m, and whether map and drive belong together";
constexpr std::array<const char*, vehicle_faults> advice = {
    belong,
    "trajectories.above = \"ground\" lets heights count from the ground; else check trajectories.offset_m, and whether "
    "map and drive belong together",
    belong,
    "nothing reflects there; check trajectories.offset_m, or import the map anew with `wavetracer convert --net` or "
    "`--traffic`"};

struct Finding {
  VehicleFault kind;
  std::string text;   // `through "house"`, "by 1.5 m"
  bool room = false;  // the body is so large that all vehicles may be meant to be inside of it
};

// grounded: most of the scene has a ground, so a place without ground is reported.
std::optional<Finding> look(const Surroundings& around, bool grounded, const Pose& pose, double height_m) {
  const glm::dvec3& p = pose.position_m;
  const auto by = [](VehicleFault kind, double metres) { return Finding{kind, fmt::format("by {:.3g} m", metres)}; };
  if (const auto depth = around.below_ground(p); depth && depth->metres > sunk_m) return by(sunk, depth->metres);
  if (const auto body = around.body_at(p + pose.orientation * glm::dvec3(0, 0, height_m / 2)))
    return Finding{through, "through " + around.name_of(body->object), !around.small(*body)};
  const auto over = around.height_above(p, step_m);
  if (over && *over < -sunk_m) return by(sunk, -*over);
  if (over && *over > step_m) return by(floating, *over);
  if (!over && grounded) {
    const glm::dvec3 at = p + around.scene().origin_m;
    return Finding{beside, fmt::format("at ({:.0f}, {:.0f}) m", at.x, at.y)};
  }
  return {};
}

// Visits the frames in which a vehicle may be present, or evenly spread ones of them.
template <class Visit>
void visit_frames(const World& world, const Track& track, uint64_t most, const Visit& visit) {
  const uint64_t frames = world.clock.frame_count();
  const double start_s = world.clock.time_s(0), step_s = world.clock.step_s();
  const auto frame_at = [&](double time_s) {
    return static_cast<uint64_t>(std::clamp((time_s - start_s) / step_s, 0.0, static_cast<double>(frames - 1)));
  };
  const uint64_t first = frame_at(track.samples.front().time_s), last = frame_at(track.samples.back().time_s);
  const uint64_t stride = (last - first) / most + 1;
  for (uint64_t frame = first; frame <= last; frame += stride)
    if (const auto pose = pose_at(track, world.clock.time_s(frame))) visit(world.clock.time_s(frame), *pose);
}

// The number of vehicles with a finding, and the first of them.
struct Count {
  uint64_t vehicles = 0;
  double time_s = 0;
  std::string id, text;
};

class Drive {
 public:
  void look_at(const Surroundings& around, const World& world) {
    const Trajectories& all = world.fleet.trajectories;
    const uint64_t most = std::max<uint64_t>(most_places / std::max<size_t>(all.tracks.size(), 1), 1);
    const bool grounded = around.has_ground();
    for (const Track& track : all.tracks) {
      std::array<bool, 2 * vehicle_faults> seen{};
      visit_frames(world, track, most, [&](double time_s, const Pose& pose) {
        const auto found = look(around, grounded, pose, all.types[track.type].height_m);
        free_ |= !found;
        if (!found || std::exchange(seen[found->kind + (found->room ? vehicle_faults : 0)], true)) return;
        Count& count = found->room ? in_rooms_ : counts_[found->kind];
        if (count.vehicles++ == 0 || time_s < count.time_s) count = {count.vehicles, time_s, track.id, found->text};
      });
    }
  }

  // If all are in a room, the room is the scene, for instance a garage.
  std::vector<std::string> warnings(size_t vehicles) const {
    std::vector<std::string> out;
    const auto say = [&](const Count& c, VehicleFault kind) {
      if (c.vehicles > 0)
        out.push_back(fmt::format("{} of {} vehicles {}, the first one \"{}\" {} from {} s on: {}", c.vehicles,
                                  vehicles, fault_words[kind], c.id, c.text, time_text(c.time_s), advice[kind]));
    };
    for (int kind = 0; kind < vehicle_faults; ++kind)
      say(counts_[static_cast<size_t>(kind)], static_cast<VehicleFault>(kind));
    if (free_) say(in_rooms_, through);
    return out;
  }

 private:
  std::array<Count, vehicle_faults> counts_;
  Count in_rooms_;
  bool free_ = false;  // a vehicle was at a place without a finding
};

}  // namespace

std::vector<std::string> vehicle_warnings(const Surroundings& around, const World& world) {
  Drive drive;
  drive.look_at(around, world);
  return drive.warnings(world.fleet.trajectories.tracks.size());
}

}  // namespace wavetracer
