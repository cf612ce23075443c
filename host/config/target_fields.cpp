// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about targets of sensing. The doc of each row gives the reason for its default; the default
// itself is the initialiser in target_config.hpp.
#include <algorithm>
#include <iterator>
#include <vector>

#include "config/field_rows.hpp"

namespace wavetracer::config {

namespace {

// The keys of a law of the user's own.
std::vector<Field> custom_fields() {
  const auto m = [](auto member) { return at(&Config::target_models, member); };
  return {
      {.name = "rcs_dbsm",
       .slot = m(&TargetModelConfig::rcs_dbsm),
       .unit = "dBsm",
       .range = {-200, 200},
       .doc = "Only with kind = \"custom\": the radar cross section of each point, the same in all "
              "directions; one number is that of all points.",
       .example = "[10.0]"},
      {.name = "lobes",
       .slot = m(&TargetModelConfig::lobes),
       .unit = "number, degrees, degrees, degrees, degrees, dBsm, dB",
       .range = {-1e3, 1e3},
       .doc = "Only with kind = \"custom\": lobes instead of rcs_dbsm. Each has the number of its point, "
              "counted from 0, the azimuth of its peak (from ahead towards left) and the width there at "
              "3 dB, the zenith of its peak (from above) and the width there, the peak, and how far below "
              "it the cross section falls at most. A width of 0: the same for all these angles. The "
              "strongest lobe of a point counts.",
       .example = "[[0, 0.0, 40.0, 90.0, 40.0, 15.0, 20.0]]"},
      {.name = "bistatic_db",
       .slot = m(&TargetModelConfig::bistatic_db),
       .range = {0, 1e3},
       .doc = "Only with kind = \"custom\": k1, k2, k3 of the loss k1 sin(k2 beta / 2) - k3 log10(cos(beta / "
              "2)) in dB at the bistatic angle beta, by which a lobe falls, to its range at most. Kinds "
              "of 3GPP have their own."},
  };
}

// The keys of a body.
std::vector<Field> body_fields() {
  const auto m = [](auto member) { return at(&Config::target_models, member); };
  return {
      {.name = "piece_m",
       .slot = m(&TargetModelConfig::piece_m),
       .unit = "m",
       .range = {0.01, 1e3},
       .doc = "Only with kind = \"body\": the longest edge of the pieces into which facets are cut. Each piece is "
              "a point with one path for each link, is lit or hidden as a whole, and has one delay and one "
              "angle. Its phase is right up to some metres from an end (64 cuts of a piece). Not given: 0.25.",
       .example = "0.1"},
      {.name = "bounces",
       .slot = m(&TargetModelConfig::bounces),
       .range = {1, 3},
       .doc = "Only with kind = \"body\": the most facets of the body that a wave meets: all but one are "
              "mirrors, and one is cut into pieces that scatter. Corners need 2 or 3, and at most "
              "trace.max_depth. Not given: 1, single scattering.",
       .example = "2"},
  };
}

}  // namespace

Table target_model_table() {
  const auto m = [](auto member) { return at(&Config::target_models, member); };
  Table out{
      .name = "target_model",
      .doc =
          "A kind of target of sensing: points that scatter by radar cross sections (docs/targets.md). Vehicles "
          "that `on` selects are such targets; [[target]] puts one at a place.",
      .fields =
          {
              {.name = "name",
               .slot = m(&TargetModelConfig::name),
               .required = true,
               .doc = "Unique among target models. The target of a vehicle is called VEHICLE/NAME.",
               .example = "\"car\""},
              {.name = "on",
               .slot = m(&TargetModelConfig::on),
               .doc = "Id or type of the vehicles that are such a target, with * for any text and ? for any "
                      "character. Empty: no vehicle is one."},
              {.name = "kind",
               .slot = m(&TargetModelConfig::kind),
               .doc = "The law of the cross section: one of 3GPP TR 38.901 V19, tables 7.9.2.1-1 to 7.9.2.1-7, at "
                      "its mean over the random part, or custom, by rcs_dbsm or lobes. -aspects depends on the "
                      "direction; -points has a point on each of four sides and on the roof. body: the facets of the "
                      "vehicle's body scatter by physical optics."},
              {.name = "points_m",
               .slot = m(&TargetModelConfig::points_m),
               .unit = "m",
               .range = places,
               .doc = "The points, relative to the middle of the footprint: ahead, left, up. Empty: with a kind of "
                      "3GPP those that follow from the size, with custom the middle of the footprint."},
              {.name = "xpr_db",
               .slot = m(&TargetModelConfig::xpr_db),
               .unit = "dB",
               .range = {-100, 400},
               .doc = "The power in the same polarisation over that in the other one. Not given: the mean of "
                      "table 7.9.2.2-1 for the kind; custom has nothing in the other one.",
               .example = "20.0"},
              {.name = "size_m",
               .slot = m(&TargetModelConfig::size_m),
               .unit = "m",
               .range = {0, 1e4, true},
               .doc = "Length, width and height, from which the places of points follow. Not given: the size "
                      "of the vehicle, or at a [[target]] that of 3GPP for the kind.",
               .example = "[4.5, 1.8, 1.5]"},
          },
      .append = append<&Config::target_models>,
      .count = count<&Config::target_models>,
      .optional = true};
  std::ranges::move(custom_fields(), std::inserter(out.fields, out.fields.begin() + 4));
  std::ranges::move(body_fields(), std::back_inserter(out.fields));
  return out;
}

Table target_table() {
  const auto m = [](auto member) { return at(&Config::targets, member); };
  return {
      .name = "target",
      .doc = "A target that stands in all frames.",
      .fields =
          {
              {.name = "name",
               .slot = m(&TargetConfig::name),
               .required = true,
               .doc = "Unique among targets.",
               .example = "\"pedestrian\""},
              {.name = "model",
               .slot = m(&TargetConfig::model),
               .required = true,
               .doc = "Name of its [[target_model]].",
               .example = "\"car\""},
              {.name = "position_m",
               .slot = m(&TargetConfig::position_m),
               .unit = "m",
               .range = places,
               .required = true,
               .doc = "The middle of its footprint, in the coordinates of the scene file.",
               .example = "[10.0, 0.0, 0.0]"},
              {.name = "orientation_deg",
               .slot = m(&TargetConfig::orientation_deg),
               .unit = "degrees",
               .range = angles,
               .doc = "Yaw, pitch, roll: intrinsic rotations about z, y, x."},
              {.name = "velocity_m_s",
               .slot = m(&TargetConfig::velocity_m_s),
               .unit = "m/s",
               .range = speeds,
               .doc = "Its velocity along the axes of the scene file, for Doppler shifts alone: it stays there."},
              {.name = "vehicle_type",
               .slot = m(&TargetConfig::vehicle_type),
               .doc = "Name of a [[vehicle_type]], whose mesh or body stands there: it hides waves, passes and "
                      "reflects them as bodies of vehicles do, and its size is that of the target. A model of kind = "
                      "\"body\" needs it. Empty: there is no body.",
               .example = "\"hatchback\""},
          },
      .append = append<&Config::targets>,
      .count = count<&Config::targets>,
      .optional = true};
}

}  // namespace wavetracer::config
