// Rows of the field table about grids of receivers, for coverage.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table receiver_grid_table() {
  const auto g = [](auto member) { return at(&Config::receiver_grids, member); };
  const auto border = [&](std::string name, auto member, std::string side, std::string example) {
    return Field{.name = std::move(name),
                 .slot = g(member),
                 .unit = "m",
                 .doc = side +
                        " border of the grid, in the coordinates of the scene file. Not given: the border of the "
                        "scene. the coordinates of the scene file. Not given: that of the scene.",
                 .example = std::move(example)};
  };
  return {
      .name = "receiver_grid",
      .doc =
          "Receivers at the centres of square cells, for a coverage map (`wavetracer plot`). They are called "
          "NAME/IX,IY, counted from 0 towards +x and +y. They follow the [[receiver]] tables, row by row: IX counts "
          "first.",
      .fields =
          {
              {.name = "name",
               .slot = g(&ReceiverGridConfig::name),
               .required = true,
               .doc = "The beginning of the names of its receivers; unique among the grids.",
               .example = "\"street\""},
              border("x_min_m", &ReceiverGridConfig::x_min_m, "Western", "-100.0"),
              border("x_max_m", &ReceiverGridConfig::x_max_m, "Eastern", "100.0"),
              border("y_min_m", &ReceiverGridConfig::y_min_m, "Southern", "-100.0"),
              border("y_max_m", &ReceiverGridConfig::y_max_m, "Northern (y_max_m = y_min_m gives a single row)",
                     "100.0"),
              {.name = "step_m",
               .slot = g(&ReceiverGridConfig::step_m),
               .unit = "m",
               .range = {0, 1e6, true},
               .doc =
                   "Side of a cell. As many cells as fit between the borders are placed in the middle, at least one. "
                   "Half the step gives four times as many receivers; more than a million receivers are an error."},
              {.name = "height_m",
               .slot = g(&ReceiverGridConfig::height_m),
               .unit = "m",
               .doc =
                   "Height of the receivers. 1.5 m is the height of a phone, and of an antenna on the roof of a car."},
              {.name = "above",
               .slot = g(&ReceiverGridConfig::above),
               .doc = "What height_m is measured from. zero: height_m is the z coordinate in the scene file. ground: "
                      "the ground at that place, for hilly terrain; where there is none, the lowest point of the "
                      "scene. The ground is what spans at least half of the scene, seen from above, or else the "
                      "lowest surface."},
              antenna_field(g, &ReceiverGridConfig::antenna),
              polarization_field(g, &ReceiverGridConfig::polarization),
              array_field(g, &ReceiverGridConfig::array),
              {.name = "orientation_deg",
               .slot = g(&ReceiverGridConfig::orientation_deg),
               .unit = "degrees",
               .doc = "Yaw, pitch, roll: intrinsic rotations about z, y, x."},
          },
      .append = append<&Config::receiver_grids>,
      .count = count<&Config::receiver_grids>,
      .optional = true};
}

}  // namespace wavetracer::config
