// Rows of the field table about grids of receivers, for coverage.
// The reason for each default stands in the doc of its row; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table receiver_grid_table() {
  const auto g = [](auto member) { return at(&Config::receiver_grids, member); };
  const auto border = [&](std::string name, auto member, std::string side, std::string example) {
    return Field{
        .name = std::move(name),
        .slot = g(member),
        .unit = "m",
        .doc = side + " border of the grid, in the coordinates of the scene file. Not given: that of the scene.",
        .example = std::move(example)};
  };
  return {
      .name = "receiver_grid",
      .doc =
          "Receivers at the middles of square cells, for a map of coverage (`wavetracer plot`). They are called "
          "NAME/IX,IY, counted from 0 towards +x and +y, and stand row by row, IX first, behind the [[receiver]]s.",
      .fields =
          {
              {.name = "name",
               .slot = g(&ReceiverGridConfig::name),
               .required = true,
               .doc = "What the names of its receivers begin with; unique among the grids.",
               .example = "\"street\""},
              border("x_min_m", &ReceiverGridConfig::x_min_m, "Western", "-100.0"),
              border("x_max_m", &ReceiverGridConfig::x_max_m, "Eastern", "100.0"),
              border("y_min_m", &ReceiverGridConfig::y_min_m, "Southern", "-100.0"),
              border("y_max_m", &ReceiverGridConfig::y_max_m, "Northern; the same as y_min_m for a single row",
                     "100.0"),
              {.name = "step_m",
               .slot = g(&ReceiverGridConfig::step_m),
               .unit = "m",
               .range = {0, 1e6, true},
               .doc =
                   "Side of a cell. As many cells as fit between the borders, in their middle, one at least. Half the "
                   "step is four times the receivers; more than a million of them are an error."},
              {.name = "height_m",
               .slot = g(&ReceiverGridConfig::height_m),
               .unit = "m",
               .doc = "Of the receivers. 1.5 m is that of a phone, and of an antenna on a car's roof."},
              {.name = "above",
               .slot = g(&ReceiverGridConfig::above),
               .doc = "zero: height_m is z in the scene file. ground: it is counted from the lowest surface at that "
                      "place, as in hilly terrain; where there is none, from the lowest point of the scene."},
              antenna_field(g, &ReceiverGridConfig::antenna),
              polarization_field(g, &ReceiverGridConfig::polarization),
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
