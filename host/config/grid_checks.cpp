// SPDX-License-Identifier: Apache-2.0
// Keys of [[receiver_grid]] that exclude each other, and the grids of several heights.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <array>
#include <string>
#include <utility>
#include <vector>
#include "config/contradictions.hpp"

namespace wavetracer::config {
namespace {

std::string grid_key(size_t i, const std::string& key) { return fmt::format("receiver_grid.{}.{}", i, key); }

void check_corners(const ReceiverGridConfig& grid, size_t i, std::vector<Contradiction>& out) {
  const auto check = [&](const char* corner, bool in_degrees, const char* border, bool in_metres) {
    if (in_degrees && in_metres)
      out.push_back({{grid_key(i, corner), grid_key(i, border)},
                     fmt::format("[[receiver_grid]] has both {} and {}: remove one of them", border, corner)});
  };
  check("south_west_wgs84", grid.south_west_wgs84.has_value(), "x_min_m", grid.x_min_m.has_value());
  check("south_west_wgs84", grid.south_west_wgs84.has_value(), "y_min_m", grid.y_min_m.has_value());
  check("north_east_wgs84", grid.north_east_wgs84.has_value(), "x_max_m", grid.x_max_m.has_value());
  check("north_east_wgs84", grid.north_east_wgs84.has_value(), "y_max_m", grid.y_max_m.has_value());
}

// Returns the keys of a horizontal grid, or those of a vertical plane, that are given.
std::vector<std::string> given_keys(const ReceiverGridConfig& grid, bool of_plane) {
  using Given = std::pair<const char*, bool>;
  const std::array<Given, 9> horizontal = {{{"x_min_m", grid.x_min_m.has_value()},
                                            {"x_max_m", grid.x_max_m.has_value()},
                                            {"y_min_m", grid.y_min_m.has_value()},
                                            {"y_max_m", grid.y_max_m.has_value()},
                                            {"south_west_wgs84", grid.south_west_wgs84.has_value()},
                                            {"north_east_wgs84", grid.north_east_wgs84.has_value()},
                                            {"height_m", grid.height_m.has_value()},
                                            {"heights_m", !grid.heights_m.empty()},
                                            {"above", from_ground(grid.above)}}};
  const std::array<Given, 4> vertical = {{{"from_m", grid.from_m.has_value()},
                                          {"to_m", grid.to_m.has_value()},
                                          {"z_min_m", grid.z_min_m.has_value()},
                                          {"z_max_m", grid.z_max_m.has_value()}}};
  std::vector<std::string> out;
  const auto add = [&](const auto& keys) {
    for (const auto& [key, given] : keys)
      if (given) out.emplace_back(key);
  };
  if (of_plane)
    add(vertical);
  else
    add(horizontal);
  return out;
}

void check_plane(const ReceiverGridConfig& grid, size_t i, std::vector<Contradiction>& out) {
  const std::vector<std::string> plane = given_keys(grid, true), others = given_keys(grid, false);
  if (plane.empty()) return;
  const auto refuse = [&](const std::vector<std::string>& names, std::string what) {
    std::vector<std::string> keys;
    for (const std::string& name : names) keys.push_back(grid_key(i, name));
    out.push_back({std::move(keys), std::move(what)});
  };
  if (!others.empty()) {
    std::vector<std::string> all = plane;
    all.insert(all.end(), others.begin(), others.end());
    refuse(all,
           fmt::format("[[receiver_grid]] has {}, of a vertical plane, and {}, of a horizontal grid: remove one or the "
                       "other. A vertical plane has from_m, to_m, z_min_m, z_max_m and step_m, where z is that of the "
                       "scene file; a horizontal grid has the borders in x and y or corners in degrees, height_m or "
                       "heights_m, above and step_m",
                       fmt::join(plane, ", "), fmt::join(others, ", ")));
  } else if (!grid.from_m || !grid.to_m) {
    refuse(plane, fmt::format("[[receiver_grid]] has {} and no {}: a vertical plane stands between from_m = [x, y] and "
                              "to_m = [x, y], so give both",
                              fmt::join(plane, ", "), !grid.from_m ? "from_m" : "to_m"));
  } else if (grid.from_m == grid.to_m) {
    refuse({"from_m", "to_m"},
           fmt::format("[[receiver_grid]] has from_m = to_m = [{:g}, {:g}], so its plane has no direction: move one of "
                       "them; for a single column give ends that are step_m apart",
                       (*grid.from_m)[0], (*grid.from_m)[1]));
  }
}

void check_heights(const ReceiverGridConfig& grid, size_t i, std::vector<Contradiction>& out) {
  if (grid.heights_m.empty()) return;
  if (grid.height_m)
    out.push_back({{grid_key(i, "height_m"), grid_key(i, "heights_m")},
                   "[[receiver_grid]] has both height_m and heights_m: remove one of them"});
  for (size_t k = 0; k < grid.heights_m.size(); ++k)
    for (size_t earlier = 0; earlier < k; ++earlier)
      if (grid.heights_m[k] == grid.heights_m[earlier]) {
        out.push_back({{grid_key(i, "heights_m")},
                       fmt::format("receiver_grid.heights_m has {} m twice: remove one of them", grid.heights_m[k])});
        return;
      }
}

}  // namespace

void check_grids(const Config& config, std::vector<Contradiction>& out) {
  for (size_t i = 0; i < config.receiver_grids.size(); ++i) {
    check_corners(config.receiver_grids[i], i, out);
    check_plane(config.receiver_grids[i], i, out);
    check_heights(config.receiver_grids[i], i, out);
  }
}

std::vector<ReceiverGridConfig> one_of_each_height(const std::vector<ReceiverGridConfig>& grids) {
  std::vector<ReceiverGridConfig> out;
  for (const ReceiverGridConfig& grid : grids) {
    if (grid.heights_m.empty()) out.push_back(grid);
    for (const double height_m : grid.heights_m) {
      ReceiverGridConfig& floor = out.emplace_back(grid);
      floor.name = fmt::format("{}@{}", grid.name, height_m);
      floor.height_m = height_m;
      floor.heights_m.clear();
    }
  }
  return out;
}

}  // namespace wavetracer::config
