// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about parts of targets that move. The doc of each row gives the reason for its default; the
// default itself is the initialiser in target_config.hpp.
#include <vector>

#include "config/field_rows.hpp"

namespace wavetracer::config {

namespace {

// The keys that one kind alone has.
std::vector<Field> kind_fields() {
  const auto m = [](auto member) { return at(&Config::target_parts, member); };
  return {{.name = "radius_m",
           .slot = m(&TargetPartConfig::radius_m),
           .unit = "m",
           .range = {0, 1e3, true},
           .doc = "Only with kind = \"wheel\": the radius, with which the wheel rolls without slip.",
           .example = "0.32"},
          {.name = "length_m",
           .slot = m(&TargetPartConfig::length_m),
           .unit = "m",
           .range = {0, 1e3, true},
           .doc = "Only with kind = \"limb\": the length of the limb, which hangs down from its joint.",
           .example = "0.85"},
          {.name = "swing_deg",
           .slot = m(&TargetPartConfig::swing_deg),
           .unit = "degrees",
           .range = {0, 180},
           .doc = "Only with kind = \"limb\": the largest angle from hanging down, ahead and back.",
           .example = "25.0"},
          {.name = "stride_m",
           .slot = m(&TargetPartConfig::stride_m),
           .unit = "m",
           .range = {0, 1e4, true},
           .doc = "Only with kind = \"limb\": the way, two steps long, on which the limb swings ahead and back once. A "
                  "person who stands does not swing.",
           .example = "1.5"}};
}

}  // namespace

Table target_part_table() {
  const auto m = [](auto member) { return at(&Config::target_parts, member); };
  Table out{
      .name = "target_part",
      .doc =
          "Points that move on the targets of a model: the rim of a wheel that rolls, or a limb that swings "
          "(docs/targets.md). They follow the points of the model.",
      .fields =
          {
              {.name = "model",
               .slot = m(&TargetPartConfig::model),
               .required = true,
               .doc = "Name of the [[target_model]] that has this part; its xpr_db is that of the part's points.",
               .example = "\"car\""},
              {.name = "kind",
               .slot = m(&TargetPartConfig::kind),
               .doc = "A wheel turns by the way of its centre over its radius. A limb swings by the sine of the way of "
                      "its vehicle."},
              {.name = "pivot_m",
               .slot = m(&TargetPartConfig::pivot_m),
               .unit = "m",
               .range = {-1e3, 1e3},
               .required = true,
               .doc = "The centre of the wheel, or the joint of the limb, relative to the middle of the footprint: "
                      "ahead, left, up.",
               .example = "[1.4, 0.8, 0.32]"},
              {.name = "axis",
               .slot = m(&TargetPartConfig::axis),
               .range = {-1e3, 1e3},
               .doc = "The axis of the wheel or of the swing: ahead, left, up, of any length. It is not upright. The "
                      "default is that of a vehicle that goes ahead."},
              {.name = "phase_deg",
               .slot = m(&TargetPartConfig::phase_deg),
               .unit = "degrees",
               .range = angles,
               .doc = "At the start of the track: the angle of a wheel's first point from the top, ahead; the phase "
                      "of a limb's sine, 0 where it hangs down and swings ahead. Legs and arms take turns with 180."},
              {.name = "points",
               .slot = m(&TargetPartConfig::points),
               .range = {1, 1000},
               .doc = "The number of points: spread evenly around the rim, or along the limb as far as its end."},
              {.name = "rcs_dbsm",
               .slot = m(&TargetPartConfig::rcs_dbsm),
               .unit = "dBsm",
               .range = {-200, 200},
               .required = true,
               .doc = "The radar cross section of each point, the same in all directions.",
               .example = "-15.0"},
          },
      .append = append<&Config::target_parts>,
      .count = count<&Config::target_parts>,
      .optional = true};
  std::vector<Field> kinds = kind_fields();
  out.fields.insert(out.fields.begin() + 4, kinds.begin(), kinds.end());
  return out;
}

}  // namespace wavetracer::config
