// SPDX-License-Identifier: Apache-2.0
// Posts of the raster become vertices: nothing is resampled, so the error at the posts is the whole error. A cell of
// the raster must be a parallelogram in the scene, to good accuracy.
#include "imports/terrain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "imports/maps_module.hpp"
#include "imports/terrain_mesh.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr size_t most_terrain_posts = 40'000'000;
constexpr int32_t most_posts_a_side = 1 << 14;  // limit of mesh_terrain()

// A raster that was opened by the module.
class RasterPart {
 public:
  RasterPart(const Extent& area, const Georeference& georeference, const ImportOptions& options)
      : file_(options.terrain.string()), module_(maps_module(file_)), offset_m_(georeference.offset_m) {
    if (!georeference.projection.empty()) projection_.emplace(georeference);
    const std::vector<double> places = border(area);
    char error[WT_MAPS_ERROR_SIZE] = {};
    if (module_.open_raster(file_.c_str(), projection_.has_value(), places.data(), places.size() / 2, 1,
                            most_terrain_posts, &raster_, error) != 0)
      throw InputError(fmt::format("{}: cannot be used as a terrain: {}", file_, error));
    heights_m.assign(raster_.heights_m, raster_.heights_m + raster_.columns * raster_.rows);
    if (std::max(raster_.columns, raster_.rows) > static_cast<size_t>(most_posts_a_side)) {
      module_.close_raster(&raster_);
      throw InputError(
          fmt::format("{}: has more than {} posts in a row or column of this area: "
                      "make it coarser with gdalwarp -tr 2 2 -r average",
                      file_, most_posts_a_side));
    }
  }
  ~RasterPart() { module_.close_raster(&raster_); }
  RasterPart(const RasterPart&) = delete;
  RasterPart& operator=(const RasterPart&) = delete;

  int32_t columns() const { return static_cast<int32_t>(raster_.columns); }
  int32_t rows() const { return static_cast<int32_t>(raster_.rows); }
  bool clipped() const { return raster_.clipped != 0; }

  // Returns the places of posts in coordinates of the scene.
  std::vector<glm::dvec2> places(const std::vector<GridPost>& posts) const {
    std::vector<double> xy;
    for (const GridPost& p : posts) {
      xy.push_back(p.column);
      xy.push_back(p.row);
    }
    module_.places_of_posts(&raster_, xy.data(), posts.size());
    std::vector<glm::dvec2> out;
    for (size_t i = 0; i < posts.size(); ++i) {
      const glm::dvec2 p{xy[2 * i], xy[2 * i + 1]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw InputError(fmt::format("{}: a post of it is outside of the area of its coordinate system", file_));
      out.push_back(projection_ ? projection_->scene(p) : p + offset_m_);
    }
    return out;
  }

  std::vector<float> heights_m;  // NaN where there is no height

 private:
  // Returns places along the border of the area, for the raster: a straight border may be a curve in its coordinates.
  std::vector<double> border(const Extent& area) const {
    constexpr int pieces = 16;
    std::vector<double> out;
    const auto add = [&](double u, double v) {
      const glm::dvec2 p = glm::mix(area.lower_m, area.upper_m, glm::dvec2(u, v));
      const glm::dvec2 q = projection_ ? projection_->geographic(p) : p - offset_m_;
      out.insert(out.end(), {q.x, q.y});
    };
    for (int k = 0; k <= pieces; ++k) {
      const double u = static_cast<double>(k) / pieces;
      add(u, 0), add(u, 1), add(0, u), add(1, u);
    }
    return out;
  }

  std::string file_;
  const MapsModule& module_;
  glm::dvec2 offset_m_;
  std::optional<Projection> projection_;
  wt_maps_raster raster_{};
};

// Posts without a height get that of the nearest post with a height in their row or column, ring by ring.
uint64_t fill_gaps(std::vector<float>& heights_m, int32_t columns, int32_t rows, const std::string& file) {
  std::vector<size_t> gaps;
  for (size_t i = 0; i < heights_m.size(); ++i)
    if (std::isnan(heights_m[i])) gaps.push_back(i);
  const uint64_t count = gaps.size();
  if (2 * count > heights_m.size())
    throw InputError(fmt::format("{}: has no height at {} of {} posts in this area", file, count, heights_m.size()));
  const auto width = static_cast<size_t>(columns), height = static_cast<size_t>(rows);
  while (!gaps.empty()) {
    std::vector<size_t> left;
    std::vector<std::pair<size_t, float>> found;
    for (const size_t i : gaps) {
      float value = NAN;
      const size_t x = i % width, y = i / width;
      if (x > 0 && std::isnan(value)) value = heights_m[i - 1];
      if (x + 1 < width && std::isnan(value)) value = heights_m[i + 1];
      if (y > 0 && std::isnan(value)) value = heights_m[i - width];
      if (y + 1 < height && std::isnan(value)) value = heights_m[i + width];
      if (std::isnan(value))
        left.push_back(i);
      else
        found.emplace_back(i, value);
    }
    for (const auto& [i, value] : found) heights_m[i] = value;
    gaps = std::move(left);
  }
  return count;
}

double on_grid(double metres) { return std::round(metres * grid_per_m) / grid_per_m; }

void turn_up(Terrain& terrain) {
  for (Triangle& t : terrain.triangles) {
    const glm::dvec3 &a = terrain.vertices[t[0]], &b = terrain.vertices[t[1]], &c = terrain.vertices[t[2]];
    if (glm::cross(b - a, c - a).z < 0) std::swap(t[1], t[2]);
  }
}

}  // namespace

Terrain read_terrain(const Extent& area, const Georeference& georeference, const ImportOptions& options) {
  RasterPart raster(area, georeference, options);
  const std::string file = options.terrain.string();
  Terrain out;
  if (const uint64_t filled = fill_gaps(raster.heights_m, raster.columns(), raster.rows(), file); filled > 0)
    out.warnings.push_back(
        fmt::format("{}: {} posts in the area have no height: they have that of a neighbour", file, filled));
  if (raster.clipped())
    out.warnings.push_back(fmt::format("{}: does not cover the whole area: the ground ends where it does", file));
  const TerrainMesh mesh = mesh_terrain(raster.columns(), raster.rows(), raster.heights_m, options.terrain_error_m);
  const TerrainError error = terrain_error(mesh, raster.columns(), raster.heights_m);
  const std::vector<glm::dvec2> places = raster.places(mesh.posts);
  for (size_t i = 0; i < places.size(); ++i) {
    const GridPost& p = mesh.posts[i];
    const double z = raster.heights_m[static_cast<size_t>(p.row) * static_cast<size_t>(raster.columns()) +
                                      static_cast<size_t>(p.column)];
    out.vertices.emplace_back(on_grid(places[i].x), on_grid(places[i].y), z);
  }
  out.triangles = mesh.triangles;
  turn_up(out);
  std::vector<std::array<glm::dvec3, 3>> corners;
  for (const Triangle& t : out.triangles)
    corners.push_back({out.vertices[t[0]], out.vertices[t[1]], out.vertices[t[2]]});
  out.ground.emplace(std::move(corners));
  const auto [lowest, highest] = std::ranges::minmax_element(raster.heights_m);
  out.summary = {raster.heights_m.size(), out.triangles.size(), error.largest_m, error.rms_m, *lowest, *highest};
  return out;
}

std::optional<double> lowest_along(const Ground& ground, std::span<const glm::dvec2> ring) {
  constexpr double step_m = 1;
  double lowest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    const double pieces = std::max(1.0, std::ceil(glm::distance(a, b) / step_m));
    for (double k = 0; k < pieces; ++k) {
      const std::optional<double> z = ground.height_m(glm::mix(a, b, k / pieces));
      if (!z) return {};
      lowest = std::min(lowest, *z);
    }
  }
  return lowest;
}

void stand_on(const Ground& ground, Plan& plan) {
  std::erase_if(plan.solids, [&](Solid& solid) {
    RingM ring;
    for (const Point& p : solid.outline.empty() ? solid.polygon.outer : solid.outline)
      ring.push_back(glm::dvec2(static_cast<double>(p.x), static_cast<double>(p.y)) / static_cast<double>(grid_per_m));
    const std::optional<double> lowest = lowest_along(ground, ring);
    if (!lowest) {
      ++plan.left_out["beyond the terrain"];
      return true;
    }
    solid.base_m = *lowest;
    return false;
  });
}

}  // namespace wavetracer::imports
