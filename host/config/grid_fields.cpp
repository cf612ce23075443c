// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about grids of receivers, for coverage.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {
namespace {

constexpr auto of_grid = [](auto member) { return at(&Config::receiver_grids, member); };

Field grid_border(std::string name, std::optional<double> ReceiverGridConfig::*member, const std::string& side,
                  std::string example, const std::string& more = "") {
  return {
      .name = std::move(name),
      .slot = of_grid(member),
      .unit = "m",
      .range = places,
      .doc = side + " border of the grid, in the coordinates of the scene file. Not given: that of the scene." + more,
      .example = std::move(example)};
}

Field grid_corner(std::string name, std::optional<std::array<double, 2>> ReceiverGridConfig::*member, std::string doc,
                  std::string example) {
  return {.name = std::move(name),
          .slot = of_grid(member),
          .unit = "degrees",
          .range = angles,
          .doc = std::move(doc),
          .example = std::move(example)};
}

Field plane_end(std::string name, std::optional<std::array<double, 2>> ReceiverGridConfig::*member, std::string doc,
                std::string example) {
  return {.name = std::move(name),
          .slot = of_grid(member),
          .unit = "m",
          .range = places,
          .doc = std::move(doc),
          .example = std::move(example)};
}

Field plane_border(std::string name, std::optional<double> ReceiverGridConfig::*member, const std::string& side,
                   std::string example) {
  return {.name = std::move(name),
          .slot = of_grid(member),
          .unit = "m",
          .range = places,
          .doc = side + " border of a vertical plane, as z in the scene file. Not given: that of the scene.",
          .example = std::move(example)};
}

// Returns the rows of the height of a grid, or of its heights.
std::array<Field, 3> height_fields() {
  return {
      {{.name = "height_m",
        .slot = of_grid(&ReceiverGridConfig::height_m),
        .unit = "m",
        .range = places,
        .doc =
            "Height of the receivers. Not given: 1.5, the height of a phone, and of an antenna on the roof of a car.",
        .example = "1.5"},
       {.name = "heights_m",
        .slot = of_grid(&ReceiverGridConfig::heights_m),
        .unit = "m",
        .range = places,
        .doc = "Instead of height_m: several heights, such as those of floors. Each makes a grid of its own, called "
               "NAME@HEIGHT, such as rooms@4.5, and all count for the limit of receivers.",
        .example = "[1.5, 4.5, 7.5]"},
       {.name = "above",
        .slot = of_grid(&ReceiverGridConfig::above),
        .doc = "The reference of height_m and heights_m. zero: a height is the z coordinate in the scene file. "
               "ground: "
               "the ground at that place, for hilly terrain; where there is none, "
               "the lowest point of the scene. The ground is what spans at least half of the scene, "
               "seen from above, or else the lowest surface."}}};
}

}  // namespace

Table receiver_grid_table() {
  const auto [height, heights, above] = height_fields();
  return {
      .name = "receiver_grid",
      .doc =
          "Receivers at the centres of square cells, for a coverage map (`wavetracer plot`). "
          "They are called NAME/IX,IY, counted from 0 towards +x and +y. They follow the [[receiver]] tables, "
          "row by row: IX counts first. With from_m and to_m the cells stand on a vertical plane, as for a facade or a "
          "cut through a street: then IX counts from from_m, and IY upwards.",
      .fields =
          {
              {.name = "name",
               .slot = of_grid(&ReceiverGridConfig::name),
               .required = true,
               .doc = "The beginning of the names of its receivers; unique among the grids.",
               .example = "\"street\""},
              grid_border("x_min_m", &ReceiverGridConfig::x_min_m, "Western", "-100.0"),
              grid_border("x_max_m", &ReceiverGridConfig::x_max_m, "Eastern", "100.0"),
              grid_border("y_min_m", &ReceiverGridConfig::y_min_m, "Southern", "-100.0"),
              grid_border("y_max_m", &ReceiverGridConfig::y_max_m, "Northern", "100.0",
                          " y_max_m = y_min_m gives a single row."),
              grid_corner(
                  "south_west_wgs84", &ReceiverGridConfig::south_west_wgs84,
                  "Instead of x_min_m and y_min_m: latitude and longitude (WGS84) of that corner, "
                  "which need a georeference.json beside the scene file (`wavetracer convert` writes one). "
                  "The borders still run along x and y of the scene, and `above` says from where height_m is measured.",
                  "[48.136, 11.573]"),
              grid_corner("north_east_wgs84", &ReceiverGridConfig::north_east_wgs84,
                          "Instead of x_max_m and y_max_m: latitude and longitude of that corner.", "[48.138, 11.577]"),
              plane_end("from_m", &ReceiverGridConfig::from_m,
                        "Instead of the borders above: x and y where a vertical plane begins. It needs to_m. Receivers "
                        "inside of a wall hear nothing, so the plane of a facade stands a little in front of it.",
                        "[10.0, -20.0]"),
              plane_end("to_m", &ReceiverGridConfig::to_m, "x and y where the vertical plane ends.", "[10.0, 20.0]"),
              plane_border("z_min_m", &ReceiverGridConfig::z_min_m, "Lower", "0.0"),
              plane_border("z_max_m", &ReceiverGridConfig::z_max_m, "Upper", "20.0"),
              {.name = "step_m",
               .slot = of_grid(&ReceiverGridConfig::step_m),
               .unit = "m",
               .range = {0, 1e6, true},
               .doc =
                   "Side of a cell. As many cells as fit between the borders are placed in the middle, at least one. "
                   "Half the step gives four times as many receivers; more than 20 million receivers are an error. "
                   "More than a million are for output.paths = false and much memory."},
              height,
              heights,
              above,
              antenna_field(of_grid, &ReceiverGridConfig::antenna),
              polarization_field(of_grid, &ReceiverGridConfig::polarization),
              array_field(of_grid, &ReceiverGridConfig::array),
              {.name = "orientation_deg",
               .slot = of_grid(&ReceiverGridConfig::orientation_deg),
               .unit = "degrees",
               .range = angles,
               .doc = "Yaw, pitch, roll: intrinsic rotations about z, y, x."},
          },
      .append = append<&Config::receiver_grids>,
      .count = count<&Config::receiver_grids>,
      .optional = true};
}

}  // namespace wavetracer::config
