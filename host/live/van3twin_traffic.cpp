// SPDX-License-Identifier: Apache-2.0
#include "live/van3twin_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "wavetracer/config.hpp"

namespace wavetracer::live::van3twin {
namespace {

constexpr uint64_t missed_rounds = 2;

}  // namespace

Traffic::Traffic(const std::vector<LiveType>& types, const LiveBounds& bounds, const Coordinates& coordinates)
    : types_(types), bounds_(bounds), coordinates_(coordinates), used_(types.size(), 0) {}

void Traffic::begin_round() {
  ++round_;
  for (auto each = vehicles_.begin(); each != vehicles_.end();) {
    if (each->second.round + missed_rounds >= round_) {
      ++each;
      continue;
    }
    --used_[each->second.type];
    each = vehicles_.erase(each);
    changed_ = true;
  }
}

Traffic::Placed Traffic::update(const LocationUpdate& update) {
  auto found = vehicles_.find(update.id);
  if (found != vehicles_.end() && found->second.round == round_) begin_round();
  size_t type = found == vehicles_.end() ? 0 : found->second.type;
  if (found == vehicles_.end()) {
    while (type < types_.size() && used_[type] >= types_[type].count) ++type;
    if (type == types_.size()) return Placed::no_place;
  }
  const double yaw = glm::radians(90 - std::remainder(update.bearing_deg, 360.0));
  glm::dvec3 position = update.position_m + coordinates_.offset_m;
  if (coordinates_.front) position -= 0.5 * types_[type].length_m * glm::dvec3(std::cos(yaw), std::sin(yaw), 0);
  const bool inside = glm::all(glm::lessThanEqual(bounds_.lower_m, position)) &&
                      glm::all(glm::lessThanEqual(position, bounds_.upper_m));
  if (!inside) {
    if (found != vehicles_.end()) {
      --used_[type];
      vehicles_.erase(found);
      changed_ = true;
    }
    return Placed::outside;
  }
  if (found == vehicles_.end()) {
    found = vehicles_.emplace(update.id, Vehicle{type, round_, {}}).first;
    ++used_[type];
    changed_ = true;
  }
  LivePose pose;
  pose.id = update.id;
  pose.type = types_[type].name;
  pose.position_m = position;
  pose.orientation = {std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)};
  Vehicle& vehicle = found->second;
  changed_ = changed_ || vehicle.pose.position_m != pose.position_m || vehicle.pose.orientation != pose.orientation;
  vehicle.round = round_;
  vehicle.pose = std::move(pose);
  return Placed::yes;
}

bool Traffic::round_is_whole() const {
  return std::ranges::all_of(vehicles_, [&](const auto& each) { return each.second.round == round_; });
}

std::vector<LivePose> Traffic::poses() {
  std::vector<LivePose> out;
  for (const auto& [id, vehicle] : vehicles_) out.push_back(vehicle.pose);
  changed_ = false;
  return out;
}

std::string Traffic::transmitter(const std::string& id) const { return antenna(id, true); }
std::string Traffic::receiver(const std::string& id) const { return antenna(id, false); }

std::string Traffic::antenna(const std::string& id, bool sending) const {
  const auto found = vehicles_.find(id);
  if (found == vehicles_.end()) return {};
  for (const MountConfig& mount : types_[found->second.type].mounts)
    if (sending ? sends(mount.role) : receives(mount.role)) return id + "/" + mount.name;
  return {};
}

}  // namespace wavetracer::live::van3twin
