// SPDX-License-Identifier: Apache-2.0
// Makes receivers one by one, in the order of their names. Borders are finite, since the configuration's fields are.
#include "simulation/receiver_grid.hpp"

#include <fmt/format.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "scene/ground.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

struct GridBorders {  // in file coordinates
  glm::dvec2 lower_m, upper_m;
};

// The borders as they are given, in metres or by a corner in degrees; else those of the scene.
GridBorders borders_of(const ReceiverGridConfig& grid, const Scene& scene, PlaceFinder& places) {
  const glm::dvec3 lower = scene.origin_m + scene.lower, upper = scene.origin_m + scene.upper;
  const auto corner = [&](const std::optional<std::array<double, 2>>& degrees, const char* key,
                          const glm::dvec2& otherwise_m) {
    if (!degrees) return otherwise_m;
    const auto& [latitude, longitude] = *degrees;
    return places.from_degrees({longitude, latitude}, fmt::format("[[receiver_grid]] \"{}\", {}", grid.name, key));
  };
  return {corner(grid.south_west_wgs84, "south_west_wgs84",
                 {grid.x_min_m.value_or(lower.x), grid.y_min_m.value_or(lower.y)}),
          corner(grid.north_east_wgs84, "north_east_wgs84",
                 {grid.x_max_m.value_or(upper.x), grid.y_max_m.value_or(upper.y)})};
}

struct Axis {
  double count, first_m;  // whole numbers, as far as they fit a double
};

Axis axis(const ReceiverGridConfig& grid, const char* letter, double lower_m, double upper_m) {
  if (!(upper_m >= lower_m))
    throw ConfigError(fmt::format(
        "[[receiver_grid]] \"{0}\": {1}_max_m = {2:g} is below {1}_min_m = {3:g} (not given, they are "
        "those of the scene{4}): exchange the two, or give both",
        grid.name, letter, upper_m, lower_m, grid.vertical() ? "" : "; with corners in degrees, those of the corners"));
  constexpr double whole = 1e-9;  // with this margin 0.3 m are three cells of 0.1 m
  const double count = std::max(std::floor((upper_m - lower_m) / grid.step_m + whole), 1.0);
  return {count, 0.5 * (lower_m + upper_m) - 0.5 * (count - 1) * grid.step_m};
}

void check_count(const ReceiverGridConfig& grid, double receivers) {
  if (receivers > static_cast<double>(max_grid_receivers))
    throw ConfigError(
        fmt::format("[[receiver_grid]] \"{}\": its cells of {:g} m make {:.0f} receivers in all grids, and "
                    "{} are the limit: use a larger step_m, or a smaller area",
                    grid.name, grid.step_m, receivers, max_grid_receivers));
}

std::vector<RadioEnd> placed(std::vector<RadioEnd> ends, const std::vector<RadioEnd>& more, PlaceFinder& places) {
  ends.insert(ends.end(), more.begin(), more.end());
  for (RadioEnd& end : ends) {
    end.position_m = places.position_m(end);
    end.position_wgs84.reset();
    end.above = "zero";
  }
  return ends;
}

GridShape plane_shape(const ReceiverGridConfig& grid, const Scene& scene) {
  const glm::dvec2 from{grid.from_m->at(0), grid.from_m->at(1)}, to{grid.to_m->at(0), grid.to_m->at(1)},
      direction = plane_direction(grid);
  const double lower_m = scene.origin_m.z + scene.lower.z, upper_m = scene.origin_m.z + scene.upper.z;
  const Axis along = axis(grid, "along", 0, glm::length(to - from));
  const Axis up = axis(grid, "z", grid.z_min_m.value_or(lower_m), grid.z_max_m.value_or(upper_m));
  check_count(grid, along.count * up.count);
  const glm::dvec2 first = from + along.first_m * direction;
  return {static_cast<uint32_t>(along.count),
          static_cast<uint32_t>(up.count),
          first.x,
          first.y,
          grid.step_m,
          up.first_m,
          {direction, 0},
          {0, 0, 1}};
}

// Refuses grids that were made in code and that no place can be given.
void check_made(const ReceiverGridConfig& grid) {
  if (!grid.heights_m.empty())
    throw ConfigError(
        fmt::format("[[receiver_grid]] \"{}\": heights_m is a key of configuration files, and a configuration that is "
                    "made in code has a grid for each height: give it height_m",
                    grid.name));
  if (grid.from_m.has_value() != grid.to_m.has_value() || (grid.vertical() && grid.from_m == grid.to_m))
    throw ConfigError(
        fmt::format("[[receiver_grid]] \"{}\": a vertical plane stands between from_m and to_m: give both, at "
                    "different places",
                    grid.name));
}

std::string cell_name(const ReceiverGridConfig& grid, uint32_t ix, uint32_t iy) {
  return fmt::format("{}/{},{}", grid.name, ix, iy);
}

// Throws ConfigError if a cell has the name of a transmitter, of a receiver of its own, or of a cell of another grid.
// Names of cells follow from their grid's, so that they need no list.
void check_names(const Config& config, const std::vector<RadioEnd>& receivers, const ReceiverGridConfig& grid,
                 const GridShape& shape) {
  const auto refuse = [&](const std::string& name) {
    throw ConfigError(
        fmt::format("[[receiver_grid]] \"{}\": a radio end of the name \"{}\" exists already: "
                    "rename one of them",
                    grid.name, name));
  };
  for (const std::vector<RadioEnd>* ends : {&config.transmitters.values(), &receivers})
    for (const RadioEnd& end : *ends)
      if (const auto cell = grid_cell(grid.name, end.name);
          cell && cell->ix < shape.columns && cell->iy < shape.rows && end.name == cell_name(grid, cell->ix, cell->iy))
        refuse(end.name);
  for (const ReceiverGridConfig& other : config.receiver_grids) {
    if (&other == &grid) break;
    if (other.name == grid.name) refuse(cell_name(grid, 0, 0));
  }
}

// Appends the cells of a grid, on all cores.
void add_cells(const ReceiverGridConfig& grid, const GridShape& shape, const Scene& scene, PlaceFinder& places,
               std::vector<RadioEnd>& out) {
  const size_t first = out.size();
  out.resize(first + shape.cells());
  const double height_m = grid.height_m.value_or(ReceiverGridConfig::default_height_m);
  const std::shared_ptr<const Ground> ground =
      !grid.vertical() && from_ground(grid.above) ? places.ground() : std::shared_ptr<const Ground>();
  tbb::parallel_for(uint32_t{0}, shape.rows, [&](uint32_t iy) {
    for (uint32_t ix = 0; ix < shape.columns; ++ix) {
      glm::dvec3 place_m = shape.at(ix, iy);
      if (!grid.vertical()) place_m.z = height_m;
      if (ground) place_m.z += ground->height_m(glm::dvec2(place_m)).value_or(scene.origin_m.z + scene.lower.z);
      RadioEnd& end = out[first + size_t{iy} * shape.columns + ix];
      end.name = cell_name(grid, ix, iy);
      end.position_m = {place_m.x, place_m.y, place_m.z};
      end.antenna = grid.antenna;
      end.polarization = grid.polarization;
      end.orientation_deg = grid.orientation_deg;
      end.array = grid.array;
    }
  });
}

}  // namespace

glm::dvec2 plane_direction(const ReceiverGridConfig& grid) {
  const glm::dvec2 way{grid.to_m->at(0) - grid.from_m->at(0), grid.to_m->at(1) - grid.from_m->at(1)};
  return way / glm::length(way);
}

GridShape grid_shape(const ReceiverGridConfig& grid, const Scene& scene, PlaceFinder& places) {
  check_made(grid);
  if (grid.vertical()) return plane_shape(grid, scene);
  const GridBorders borders = borders_of(grid, scene, places);
  const Axis x = axis(grid, "x", borders.lower_m.x, borders.upper_m.x);
  const Axis y = axis(grid, "y", borders.lower_m.y, borders.upper_m.y);
  check_count(grid, x.count * y.count);
  return {static_cast<uint32_t>(x.count), static_cast<uint32_t>(y.count), x.first_m, y.first_m, grid.step_m};
}

std::vector<RadioEnd> standing_transmitters(const Config& config, PlaceFinder& places) {
  return placed(config.transmitters, config.stations, places);
}

std::vector<RadioEnd> standing_receivers(const Config& config, const Scene& scene, PlaceFinder& places) {
  std::vector<RadioEnd> out = placed(config.receivers, config.stations, places);
  if (config.receiver_grids.empty()) return out;
  std::vector<GridShape> shapes;
  uint64_t cells = 0;
  for (const ReceiverGridConfig& grid : config.receiver_grids) {
    shapes.push_back(grid_shape(grid, scene, places));
    cells += shapes.back().cells();
    check_count(grid, static_cast<double>(cells));
    check_names(config, out, grid, shapes.back());
  }
  out.reserve(out.size() + cells);
  for (size_t i = 0; i < shapes.size(); ++i) add_cells(config.receiver_grids[i], shapes[i], scene, places, out);
  return out;
}

std::optional<GridCell> grid_cell(const std::string& grid, const std::string& receiver) {
  if (!receiver.starts_with(grid + "/")) return {};
  const char *const begin = receiver.data() + grid.size() + 1, *const end = receiver.data() + receiver.size();
  GridCell cell;
  const auto x = std::from_chars(begin, end, cell.ix);
  if (x.ec != std::errc{} || x.ptr == end || *x.ptr != ',') return {};
  const auto y = std::from_chars(x.ptr + 1, end, cell.iy);
  if (y.ec != std::errc{} || y.ptr != end) return {};
  return cell;
}

}  // namespace wavetracer
