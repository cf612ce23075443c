// SPDX-License-Identifier: Apache-2.0
// The city generator: it decides which building stands where. Random numbers are PCG32 (O'Neill 2014) with integer
// ranges only. Each block draws from its own stream, so a block keeps its buildings when the city grows.
#include "scene/city.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/pending_folder.hpp"
#include "scene/city_building.hpp"
#include "scene/ply.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using city::grid_per_m;

constexpr int foundation = 1 * grid_per_m;  // below the ground, so that no face lies in the ground's plane
constexpr int floor_height = 26;            // 3.25 m
constexpr double margin_m = 20;             // ground beyond the outer streets

class Random {
 public:
  Random(uint64_t seed, uint64_t stream) : increment_(2 * stream + 1) {
    next();
    state_ += seed;
    next();
  }
  // Returns a whole number from low to high, both included. The bias of the remainder is below 2^-24 for the ranges
  // used here.
  int range(int low, int high) { return low + static_cast<int>(next() % static_cast<uint32_t>(high - low + 1)); }
  bool chance(int percent) { return range(1, 100) <= percent; }

 private:
  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005u + increment_;
    const auto xorshifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<uint32_t>(old >> 59);
    return (xorshifted >> rotation) | (xorshifted << ((0u - rotation) & 31u));
  }
  uint64_t state_ = 0, increment_;
};

struct Rectangle {  // grid units
  int x0, y0, x1, y1;
  int width() const { return x1 - x0; }
  int depth() const { return y1 - y0; }
};

class CityBuilder {
 public:
  explicit CityBuilder(const CityOptions& options) : options_(options) {
    raw_.file = "generated city";
    material(options.ground);
    const double pitch = options.block_m + options.street_m;
    const double x = (options.blocks_x * pitch + options.street_m) / 2 + margin_m;
    const double y = (options.blocks_y * pitch + options.street_m) / 2 + margin_m;
    raw_.meshes.push_back(
        {"ground", raw_.file, {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}}, 0});
  }

  RawScene build() {
    const int pitch = static_cast<int>(options_.block_m + options_.street_m) * grid_per_m;
    const int side = static_cast<int>(options_.block_m) * grid_per_m,
              street = static_cast<int>(options_.street_m) * grid_per_m;
    for (uint32_t j = 0; j < options_.blocks_y; ++j) {
      for (uint32_t i = 0; i < options_.blocks_x; ++i) {
        random_ = Random(options_.seed, uint64_t{j} << 32 | i);
        const int x = static_cast<int>(i) * pitch - static_cast<int>(options_.blocks_x) * pitch / 2 + street / 2;
        const int y = static_cast<int>(j) * pitch - static_cast<int>(options_.blocks_y) * pitch / 2 + street / 2;
        block({x, y, x + side, y + side});
      }
    }
    return std::move(raw_);
  }

 private:
  // If a call needs several random numbers, each is stored in a variable first: the order in which arguments are
  // evaluated is the compiler's choice.
  int metres(int low, int high) { return random_.range(low, high) * grid_per_m; }
  int height() {
    return random_.range(static_cast<int>(options_.min_floors), static_cast<int>(options_.max_floors)) * floor_height;
  }

  void block(const Rectangle& r) {
    const int kind = random_.range(1, 10);
    if (kind <= 2) {
      perimeter_block(r);
    } else if (kind == 3) {
      plaza(r);
    } else {
      const int rows = random_.range(2, 3), columns = random_.range(3, 4);
      lots(r, columns, rows);
    }
  }

  // A ring around a courtyard, in which a lower building may stand.
  void perimeter_block(const Rectangle& r) {
    const int wing = metres(11, 14), setback = metres(0, 2);
    const Rectangle outer{r.x0 + setback, r.y0 + setback, r.x1 - setback, r.y1 - setback};
    const char* walls = random_.chance(50) ? "marble" : "brick";
    add_flat(cells(outer, wing, wing, city::ring_cells), height(), walls);
    const int yard = std::min(outer.width(), outer.depth()) - 2 * wing;
    if (yard < 24 * grid_per_m || !random_.chance(70)) return;
    const int gap = 6 * grid_per_m;
    house({outer.x0 + wing + gap, outer.y0 + wing + gap, outer.x1 - wing - gap, outer.y1 - wing - gap},
          floor_height * random_.range(1, 2));
  }

  // A tower that is turned against the streets, with a low L-shaped building at its side.
  void plaza(const Rectangle& r) {
    const int unit = r.width() / 80;  // the turned square has sides of 5 units * 6, and spans 42 units
    const int centre_x = (r.x0 + r.x1) / 2, y0 = r.y0 + 30 * unit;
    city::Footprint tower;
    tower.frame = {{centre_x, y0}, {4, 3}, {-3, 4}};
    tower.a = tower.b = {0, 2 * unit, 4 * unit, 6 * unit};
    tower.cells = city::full_cells;
    const int max_floors = static_cast<int>(options_.max_floors);
    add_flat(tower, floor_height * random_.range(max_floors, 2 * max_floors), "glass");
    const Rectangle low{r.x0 + unit, r.y0 + unit, r.x1 - unit, r.y0 + 26 * unit};
    add_flat(cells(low, 14 * unit, 12 * unit, city::l_cells), floor_height * random_.range(1, 3), "concrete");
  }

  // Columns of lots, each with its own building.
  void lots(const Rectangle& r, int columns, int rows) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const Rectangle lot{r.x0 + r.width() * i / columns, r.y0 + r.depth() * j / rows,
                            r.x0 + r.width() * (i + 1) / columns, r.y0 + r.depth() * (j + 1) / rows};
        // A building is set back by 1 to 3 m on each side, in steps of 1/4 m so that a gabled building has an even
        // width.
        const auto setback = [this] { return 2 * random_.range(4, 12); };
        const Rectangle plot{even(lot.x0) + setback(), even(lot.y0) + setback(), even(lot.x1) - setback(),
                             even(lot.y1) - setback()};
        if (random_.chance(4)) continue;  // a gap in the row
        building(plot);
      }
    }
  }
  static int even(int x) { return x & ~1; }

  void building(const Rectangle& r) {
    const int smaller = std::min(r.width(), r.depth());
    const int shape = random_.range(1, 100);
    if (shape <= 45 && smaller <= 24 * grid_per_m) {
      house(r, height());
    } else if (shape <= 70) {
      const char* walls = wall_material();
      add_flat(cells(r, r.width() / 3, r.depth() / 3, 1), height(), walls);
    } else {
      constexpr uint32_t shapes[] = {city::l_cells, city::u_cells, city::t_cells};
      const char* walls = wall_material();
      const int top = height();
      add_flat(cells(r, r.width() / 3, r.depth() / 3, shapes[random_.range(0, 2)]), top, walls);
    }
  }

  void house(const Rectangle& r, int eaves) {
    city::Footprint footprint = cells(r, 0, 0, 1);
    const int smaller = std::min(r.width(), r.depth());
    const int rise = smaller * random_.range(2, 5) / 10;  // roofs of 22 to 45 degrees
    const char* roof = random_.chance(80) ? "brick" : "metal";
    add(city::gabled_building(footprint, foundation, eaves, rise), wall_material(), roof);
  }

  const char* wall_material() {
    constexpr const char* names[] = {"concrete", "concrete", "brick", "brick", "marble", "glass", "wood"};
    return names[random_.range(0, 6)];
  }

  // Returns a footprint of 3 x 3 cells whose outer ones are wing_a and wing_b wide. A mask of 1 makes the rectangle a
  // single cell.
  static city::Footprint cells(const Rectangle& r, int wing_a, int wing_b, uint32_t mask) {
    city::Footprint out;
    out.a = {r.x0, r.x0 + wing_a, r.x1 - wing_a, r.x1};
    out.b = {r.y0, r.y0 + wing_b, r.y1 - wing_b, r.y1};
    out.cells = mask;
    if (mask == 1) {
      out.a[1] = out.a[2] = r.x1;
      out.b[1] = out.b[2] = r.y1;
    }
    return out;
  }

  void add_flat(const city::Footprint& footprint, int top, const char* walls) {
    add(city::flat_building(footprint, foundation, top), walls, random_.chance(60) ? "concrete" : "metal");
  }

  void add(city::BuildingMeshes meshes, const char* walls, const char* roof) {
    const std::string name = fmt::format("building_{:04}", ++buildings_);
    meshes.walls.name = name + "_walls";
    meshes.roof.name = name + "_roof";
    meshes.walls.material = material(walls);
    meshes.roof.material = material(roof);
    for (RawMesh* mesh : {&meshes.walls, &meshes.roof}) {
      mesh->where = raw_.file;
      raw_.meshes.push_back(std::move(*mesh));
    }
  }

  uint32_t material(const std::string& itu_name) {
    const auto found = std::find_if(raw_.materials.begin(), raw_.materials.end(),
                                    [&](const RawMaterial& m) { return m.name == itu_name; });
    if (found != raw_.materials.end()) return static_cast<uint32_t>(found - raw_.materials.begin());
    raw_.materials.push_back({itu_name, raw_.file, {}, {}, {}, {}});
    return static_cast<uint32_t>(raw_.materials.size() - 1);
  }

  const CityOptions& options_;
  RawScene raw_;
  Random random_{0, 0};
  uint32_t buildings_ = 0;
};

}  // namespace

RawScene generate_city(const CityOptions& options) { return CityBuilder(options).build(); }

void write_city(const CityOptions& options, const std::filesystem::path& folder) {
  const RawScene city = generate_city(options);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RuntimeError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  PendingFolder files(folder / "meshes", PendingFolder::Earlier::kept);
  std::string xml = "<scene version=\"2.1.0\">\n";
  for (const RawMaterial& m : city.materials) {
    xml += fmt::format(
        "  <bsdf type=\"itu-radio-material\" id=\"mat-itu_{0}\">\n    <string name=\"type\" value=\"{0}\"/>\n"
        "    <float name=\"thickness\" value=\"0.1\"/>\n  </bsdf>\n",
        m.name);
  }
  for (const RawMesh& mesh : city.meshes) {
    files.append(mesh.name + ".ply", format_ply(mesh.vertices, mesh.triangles));
    xml += fmt::format(
        "  <shape type=\"ply\" id=\"mesh-{0}\">\n    <string name=\"filename\" value=\"meshes/{0}.ply\"/>\n"
        "    <boolean name=\"face_normals\" value=\"true\"/>\n    <ref id=\"mat-itu_{1}\" name=\"bsdf\"/>\n"
        "  </shape>\n",
        mesh.name, city.materials[mesh.material].name);
  }
  files.commit();
  write_file(folder / "city.xml", xml + "</scene>\n");
}

std::vector<CityPosition> example_positions(const CityOptions& options) {
  const double pitch = options.block_m + options.street_m;
  const double x = options.blocks_x % 2 == 0 ? 0 : pitch / 2, y = options.blocks_y % 2 == 0 ? 0 : pitch / 2;
  const double kerb = options.street_m * 0.375, lane = options.street_m * 0.125;
  return {{"road-side unit at the central crossing", {x + kerb, y + kerb, 6}},
          {"vehicle south of the crossing", {x + lane, y - 0.55 * pitch, 1.5}},
          {"vehicle east of the crossing, behind the corner", {x + 0.9 * pitch, y - lane, 1.5}},
          {"vehicle one street further north", {x + 0.4 * pitch, y + pitch - lane, 1.5}}};
}

}  // namespace wavetracer
