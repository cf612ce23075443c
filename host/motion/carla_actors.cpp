// SPDX-License-Identifier: Apache-2.0
// Boxes may come after the places of their actors, so samples wait for the end of the file.
#include "motion/carla_actors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "motion/input_text.hpp"
#include "motion/track_motion.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double centimetre = 0.01, degrees = std::numbers::pi / 180;

glm::dvec3 carla_metres(const glm::dvec3& v) { return centimetre * glm::dvec3(v.x, -v.y, v.z); }

std::string_view carla_type(const CarlaActor& actor) {
  if (actor.blueprint.starts_with("walker.")) return "pedestrian";
  if (!actor.base_type.empty()) return actor.base_type;
  return actor.two_wheels ? "motorcycle" : "passenger";
}

}  // namespace

void CarlaActor::attribute(std::string_view key, std::string_view value) {
  if (key == "base_type") base_type = lower_case(value);
  if (key == "role_name") role = value;
  if (key == "number_of_wheels") two_wheels = value == "2";
}

void CarlaActor::box(const glm::dvec3& centre, const glm::dvec3& half) {
  box_centre_m = carla_metres(centre);
  box_half_m = centimetre * half;
}

CarlaActor& CarlaTracks::create(uint64_t number, std::string blueprint) {
  CarlaActor& actor = actors_[number];
  actor = {};
  actor.blueprint = std::move(blueprint);
  return actor;
}

CarlaActor* CarlaTracks::moving(uint64_t number) {
  const auto actor = actors_.find(number);
  return actor != actors_.end() && actor->second.moves() ? &actor->second : nullptr;
}

Trajectories CarlaTracks::finish(std::string_view no_samples) {
  uint64_t heroes = 0;
  for (const auto& [number, actor] : actors_) heroes += actor.role == "hero";
  for (const CarlaSample& sample : samples_) place(sample, heroes == 1);
  if (samples_.empty())
    throw InputError(fmt::format("{}: the recording has no positions of vehicles; {}", tracks_.file(), no_samples));
  if (unsized_ > 0)
    tracks_.warn(fmt::format(
        "{}: {} samples are of actors without a bounding box, which have the size of their class: start the recording "
        "with additional_data=True",
        tracks_.file(), unsized_));
  return tracks_.finish(ReferencePoint::centre);
}

void CarlaTracks::place(const CarlaSample& from, bool one_hero) {
  const CarlaActor& actor = actors_.at(from.actor);
  Sample sample;
  sample.time_s = from.time_s;
  sample.position_m = carla_metres(from.location);
  sample.yaw_rad = -degrees * std::remainder(from.rotation.z, 360.0);
  sample.pitch_rad = degrees * std::remainder(from.rotation.y, 360.0);
  std::optional<glm::dvec3> size_m;
  if (actor.box_half_m && is_size(2.0 * *actor.box_half_m)) {
    size_m = 2.0 * *actor.box_half_m;
    const glm::dvec3 arm_m = *actor.box_centre_m - glm::dvec3(0, 0, actor.box_half_m->z);
    sample.position_m += turned_arm(arm_m, sample.yaw_rad, sample.pitch_rad);
  } else {
    ++unsized_;
  }
  const std::string id = one_hero && actor.role == "hero" ? "hero" : fmt::format("{}", from.actor);
  tracks_.add(id, carla_type(actor), sample, from.line, fmt::format("actor {}", from.actor), size_m);
}

}  // namespace wavetracer
