// SPDX-License-Identifier: Apache-2.0
// Windows are computed in double, with + - * / sqrt and the angles of elementary.h, so they are the same on every host.
#include "simulation/launch_windows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "wavetracer/device/directions.h"
#include "wavetracer/device/elementary.h"
#include "wavetracer/device/moving.h"

namespace wavetracer {
namespace {

// The largest useful window, a twelfth of the sphere: above it a launch in all directions meets enough.
constexpr double largest_sr = 1;
constexpr double to_spare = 0.01;     // margin, as a part of the longer side of a window
constexpr double rounding = 5e-7;     // error of float32 directions
constexpr double steep = 0.7;         // above this sine of the elevation a window is never level
constexpr double level_price = 1.5;   // a level window may be this much larger than one that is not
constexpr double ahead_share = 0.99;  // rays start at this part of the way to the box

std::array<glm::dvec3, 8> corners(const LaunchBounds& box, const glm::dvec3& p) {
  std::array<glm::dvec3, 8> out;
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = glm::dvec3(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                        i & 4 ? box.upper.z : box.lower.z) -
             p;
  return out;
}

double sine_of(double height_m, double way_m) {
  return height_m == 0 ? 0 : height_m / std::sqrt(height_m * height_m + way_m * way_m);
}

void spare(LaunchWindow& window) {
  const double more = to_spare * std::max(2 * window.half_rad, window.high - window.low) + rounding;
  window.half_rad = std::min(window.half_rad + more, WT_PI);
  window.low = std::max(window.low - more, -1.0);
  window.high = std::min(window.high + more, 1.0);
}

// The window with z up: azimuths and elevations of the box. There is none for a box that is straight above or below.
std::optional<LaunchWindow> level_window(const LaunchBounds& box, const glm::dvec3& p) {
  const double way_x = std::max({box.lower.x - p.x, p.x - box.upper.x, 0.0});
  const double way_y = std::max({box.lower.y - p.y, p.y - box.upper.y, 0.0});
  const double near_m = std::sqrt(way_x * way_x + way_y * way_y);
  const glm::dvec3 middle = (box.lower + box.upper) / 2.0 - p;
  const double length_m = std::sqrt(middle.x * middle.x + middle.y * middle.y);
  if (!(near_m > 0) || !(length_m > 0)) return {};
  LaunchWindow out{{middle.x / length_m, middle.y / length_m, 0}, {}, {0, 0, 1}, 0, 0, 0, 0, true};
  out.y = {-out.x.y, out.x.x, 0};
  double far_m = 0;
  for (const glm::dvec3& c : corners(box, p)) {
    out.half_rad = std::max(out.half_rad, std::abs(device::wt_atan2(glm::dot(c, out.y), glm::dot(c, out.x))));
    far_m = std::max(far_m, std::sqrt(c.x * c.x + c.y * c.y));
  }
  const double top_m = box.upper.z - p.z, bottom_m = box.lower.z - p.z;
  out.high = sine_of(top_m, top_m > 0 ? near_m : far_m);
  out.low = sine_of(bottom_m, bottom_m < 0 ? near_m : far_m);
  spare(out);
  return out;
}

// The window around the direction to the middle of the box, with z as far up as possible. There is none for a box that
// is around p, or beside it.
std::optional<LaunchWindow> tilted_window(const LaunchBounds& box, const glm::dvec3& p) {
  const glm::dvec3 middle = (box.lower + box.upper) / 2.0 - p;
  LaunchWindow out{};
  out.x = middle / std::sqrt(glm::dot(middle, middle));
  const glm::dvec3 up = std::abs(out.x.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 across = up - glm::dot(up, out.x) * out.x;
  out.z = across / std::sqrt(glm::dot(across, across));
  out.y = glm::cross(out.z, out.x);
  double near_m = glm::dot(middle, out.x), highest_m = 0, lowest_m = 0;
  for (const glm::dvec3& c : corners(box, p)) {
    near_m = std::min(near_m, glm::dot(c, out.x));
    highest_m = std::max(highest_m, glm::dot(c, out.z));
    lowest_m = std::min(lowest_m, glm::dot(c, out.z));
    out.half_rad = std::max(out.half_rad, std::abs(device::wt_atan2(glm::dot(c, out.y), glm::dot(c, out.x))));
  }
  if (!(near_m > 0)) return {};
  out.high = sine_of(highest_m, near_m);
  out.low = sine_of(lowest_m, near_m);
  spare(out);
  return out;
}

// The part of a table between two heights, which has the table's shares.
std::vector<float> part_of(std::span<const float> table, double low, double high) {
  // It returns the place, in cells, at which the table reaches a height; heights fall from 1 to -1.
  const auto place_of = [&](double height) {
    size_t k = 1;
    while (k + 1 < table.size() && double{table[k]} > height) ++k;
    const double above = table[k - 1], wide = above - table[k];
    const double part = wide > 0 ? (above - height) / wide : 0;
    return static_cast<double>(k - 1) + std::clamp(part, 0.0, 1.0);
  };
  const double first = place_of(high), last = place_of(low);
  std::vector<float> out;
  for (uint32_t i = 0; i < height_table_size; ++i) {
    const double place = first + (last - first) * i / WT_HEIGHT_CELLS;
    const size_t k = std::min(static_cast<size_t>(place), table.size() - 2);
    const double part = place - static_cast<double>(k);
    out.push_back(static_cast<float>(table[k] + part * (double{table[k + 1]} - table[k])));
  }
  return out;
}

}  // namespace

void LaunchBounds::add(const glm::dvec3& low, const glm::dvec3& high) {
  lower = glm::min(lower, low);
  upper = glm::max(upper, high);
}

std::optional<LaunchWindow> window_to(const LaunchBounds& box, const glm::dvec3& p) {
  const glm::dvec3 beside = glm::max(glm::max(box.lower - p, p - box.upper), glm::dvec3(0));
  const double apart_m = std::sqrt(glm::dot(beside, beside));
  if (box.empty() || !(apart_m > 0)) return {};
  const std::optional<LaunchWindow> tilted = tilted_window(box, p), level = level_window(box, p);
  std::optional<LaunchWindow> out = tilted ? tilted : level;
  if (tilted && level && std::abs(tilted->x.z) < steep && level->solid_angle() <= level_price * tilted->solid_angle())
    out = level;
  if (!out || out->solid_angle() > largest_sr) return {};
  out->ahead_m = ahead_share * apart_m;
  return out;
}

LaunchWindows::LaunchWindows(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances,
                             bool followed)
    : instances_(instances), followed_(followed) {
  if (!scene.surfaces.empty()) scene_.add(scene.lower, scene.upper);
  for (const Scene& model : models)
    radius_m_.push_back(glm::length(glm::max(glm::abs(model.lower), glm::abs(model.upper))));
}

LaunchBounds LaunchWindows::vehicles(const WorldState& state, uint32_t source) const {
  LaunchBounds out;
  for (uint32_t i = 0; i < state.instances.size(); ++i) {
    const Placement& body = state.instances[i];
    if (!body.present || source == (WT_OWN | i)) continue;
    const glm::dvec3 radius_m(radius_m_[instances_[i].model]);
    out.add(body.position_m - radius_m, body.position_m + radius_m);
  }
  return out;
}

Launcher LaunchWindows::through(const LaunchWindow& window, Launcher from, SlopeTables& tables) const {
  static const std::vector<float> even = height_table({}, 1);
  const bool spread = window.level && !tables.of_origin.empty();
  const std::span<const float> table =
      spread ? std::span<const float>(tables.values).subspan(from.heights * height_table_size, height_table_size)
             : std::span<const float>(even);
  std::vector<float> values;
  if (window.level)
    values = part_of(table, window.low, window.high);
  else
    for (uint32_t i = 0; i < height_table_size; ++i)
      values.push_back(static_cast<float>(window.high + (window.low - window.high) * i / WT_HEIGHT_CELLS));
  const double ahead_m = followed_ ? 0 : window.ahead_m;
  values.push_back(static_cast<float>(std::min(window.half_rad / WT_PI, 1.0) * 4294967040.0));
  values.push_back(static_cast<float>(ahead_m));
  for (const glm::dvec3& axis : {window.x, window.y, window.z})
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(axis[k]));
  values.resize(2 * size_t{height_table_size});  // room for two tables
  from.heights = static_cast<uint32_t>(tables.values.size() / height_table_size);
  from.window = true;
  from.position_m += ahead_m * window.x;
  tables.values.insert(tables.values.end(), values.begin(), values.end());
  return from;
}

std::vector<Launcher> LaunchWindows::of(const std::vector<Launcher>& launchers, const WorldState& state,
                                        SlopeTables& tables) const {
  std::vector<Launcher> out;
  for (const Launcher& from : launchers) {
    const std::optional<LaunchWindow> still = window_to(scene_, from.position_m);
    if (!still && !scene_.empty()) {
      out.push_back(from);
      continue;
    }
    const LaunchBounds moving = vehicles(state, from.source);
    if (moving.empty()) {
      out.push_back(still ? through(*still, from, tables) : from);
      continue;
    }
    LaunchBounds both = moving;
    if (still) both.add(scene_.lower, scene_.upper);
    const std::optional<LaunchWindow> all = window_to(both, from.position_m);
    if (all && (!still || all->solid_angle() <= 2 * still->solid_angle())) {
      out.push_back(through(*all, from, tables));
      continue;
    }
    if (still && !followed_) out.push_back(through(*still, from, tables));
    const std::optional<LaunchWindow> elsewhere = window_to(moving, from.position_m);
    out.push_back(elsewhere && !(still && followed_) ? through(*elsewhere, from, tables) : from);
  }
  return out;
}

}  // namespace wavetracer
