// The ground below all receivers of a grid is found triangle by triangle, each over the cells that it covers.
// Assumes borders that are finite, as the configuration's fields are.
#include "simulation/receiver_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <set>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

struct Axis {
  double count, first_m;  // a whole number, as far as it fits a double
};

Axis axis(const ReceiverGridConfig& grid, const char* letter, double lower_m, double upper_m) {
  if (!(upper_m >= lower_m))
    throw ConfigError(
        fmt::format("[[receiver_grid]] \"{0}\": {1}_max_m = {2:g} is below {1}_min_m = {3:g} (not given, "
                    "they are those of the scene): exchange the two, or give both",
                    grid.name, letter, upper_m, lower_m));
  constexpr double whole = 1e-9;  // so that 0.3 m are three cells of 0.1 m
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

// The lowest z at which a vertical line meets the triangle; nothing where it passes it by or the triangle is vertical.
std::optional<double> height_at(const glm::dvec2& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto area = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
  const glm::dvec2 pa = glm::dvec2(a) - p, pb = glm::dvec2(b) - p, pc = glm::dvec2(c) - p;
  const double wa = area(pb, pc), wb = area(pc, pa), wc = area(pa, pb), sum = wa + wb + wc;
  const bool inside = (wa >= 0 && wb >= 0 && wc >= 0) || (wa <= 0 && wb <= 0 && wc <= 0);
  if (!inside || sum == 0) return {};
  return (wa * a.z + wb * b.z + wc * c.z) / sum;
}

// Lowest surface below each receiver, recentred z.
std::vector<double> ground_m(const GridShape& shape, const Scene& scene) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> z_m(size_t{shape.columns} * shape.rows, none);
  const glm::dvec2 first{shape.x_m - scene.origin_m.x, shape.y_m - scene.origin_m.y};
  const auto cells = [&](double lower_m, double upper_m, double first_m, double count) {
    const double from = std::clamp(std::ceil((lower_m - first_m) / shape.step_m), 0.0, count);
    const double to = std::clamp(std::floor((upper_m - first_m) / shape.step_m) + 1, from, count);
    return std::pair{static_cast<uint32_t>(from), static_cast<uint32_t>(to)};
  };
  for (const auto& corners : scene.triangles) {
    const glm::dvec3 &a = scene.vertices[corners[0]], &b = scene.vertices[corners[1]], &c = scene.vertices[corners[2]];
    const auto [left, right] = cells(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), first.x, shape.columns);
    const auto [low, high] = cells(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), first.y, shape.rows);
    for (uint32_t iy = low; iy < high; ++iy)
      for (uint32_t ix = left; ix < right; ++ix)
        if (const auto z = height_at(first + shape.step_m * glm::dvec2(ix, iy), a, b, c)) {
          double& lowest = z_m[size_t{iy} * shape.columns + ix];
          lowest = std::min(lowest, *z);
        }
  }
  std::replace(z_m.begin(), z_m.end(), none, scene.lower.z);
  return z_m;
}

}  // namespace

GridShape grid_shape(const ReceiverGridConfig& grid, const Scene& scene) {
  const glm::dvec3 lower = scene.origin_m + scene.lower, upper = scene.origin_m + scene.upper;
  const Axis x = axis(grid, "x", grid.x_min_m.value_or(lower.x), grid.x_max_m.value_or(upper.x));
  const Axis y = axis(grid, "y", grid.y_min_m.value_or(lower.y), grid.y_max_m.value_or(upper.y));
  check_count(grid, x.count * y.count);
  return {static_cast<uint32_t>(x.count), static_cast<uint32_t>(y.count), x.first_m, y.first_m, grid.step_m};
}

std::vector<RadioEnd> standing_receivers(const Config& config, const Scene& scene) {
  std::vector<RadioEnd> out = config.receivers;
  if (config.receiver_grids.empty()) return out;
  std::set<std::string> taken;
  for (const auto* ends : {&config.transmitters, &config.receivers})
    for (const RadioEnd& end : *ends) taken.insert(end.name);
  for (const ReceiverGridConfig& grid : config.receiver_grids) {
    const GridShape shape = grid_shape(grid, scene);
    check_count(grid, static_cast<double>(out.size() - config.receivers.size() + uint64_t{shape.columns} * shape.rows));
    const std::vector<double> ground = grid.above == "ground" ? ground_m(shape, scene) : std::vector<double>{};
    for (uint32_t iy = 0; iy < shape.rows; ++iy)
      for (uint32_t ix = 0; ix < shape.columns; ++ix) {
        const double zero_m = ground.empty() ? 0 : scene.origin_m.z + ground[size_t{iy} * shape.columns + ix];
        RadioEnd end{
            .name = fmt::format("{}/{},{}", grid.name, ix, iy),
            .position_m = {shape.x_m + ix * shape.step_m, shape.y_m + iy * shape.step_m, zero_m + grid.height_m},
            .antenna = grid.antenna,
            .polarization = grid.polarization,
            .orientation_deg = grid.orientation_deg,
            .array = grid.array};
        if (!taken.insert(end.name).second)
          throw ConfigError(
              fmt::format("[[receiver_grid]] \"{}\": a radio end of the name \"{}\" exists already: "
                          "rename one of them",
                          grid.name, end.name));
        out.push_back(std::move(end));
      }
  }
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
