// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about fixed objects: the static scene, radio materials and radio ends.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include <utility>

#include "config/field_rows.hpp"

namespace wavetracer::config {
namespace {

template <auto List>
Table ends_table(std::string name, std::string doc, std::string example_name, std::string example_position,
                 bool optional = false) {
  const auto e = [](auto member) { return at(List, member); };
  return {
      .name = std::move(name),
      .doc = std::move(doc),
      .fields =
          {
              {.name = "name",
               .slot = e(&RadioEnd::name),
               .required = true,
               .doc = "Unique among all transmitters, receivers and stations.",
               .example = std::move(example_name)},
              {.name = "position_m",
               .slot = e(&RadioEnd::position_m),
               .unit = "m",
               .range = places,
               .required = true,
               .instead = "position_wgs84",
               .doc = "x, y, z in the coordinates of the scene file.",
               .example = std::move(example_position)},
              {.name = "position_wgs84",
               .slot = e(&RadioEnd::position_wgs84),
               .unit = "degrees, degrees, m",
               .range = places,
               .doc = "Instead of position_m: latitude, longitude (WGS84) and height above the ground of the scene, "
                      "which needs a georeference.json beside its file (`wavetracer convert` writes one).",
               .example = "[48.137, 11.575, 6.0]"},
              {.name = "above",
               .slot = e(&RadioEnd::above),
               .doc = "The reference of the z of position_m. zero: it is that of the scene file. "
                      "ground: the ground of the scene at that place."},
              antenna_field(e, &RadioEnd::antenna),
              polarization_field(e, &RadioEnd::polarization),
              array_field(e, &RadioEnd::array),
              {.name = "orientation_deg",
               .slot = e(&RadioEnd::orientation_deg),
               .unit = "degrees",
               .range = angles,
               .doc = "Yaw, pitch, roll: intrinsic rotations about z, y, x."},
              {.name = "velocity_m_s",
               .slot = e(&RadioEnd::velocity_m_s),
               .unit = "m/s",
               .range = speeds,
               .doc = "Velocity along x, y, z. It gives the Doppler shift of each path; the position does not change."},
          },
      .append = append<List>,
      .count = count<List>,
      .optional = optional};
}

Field plane_tolerance_field() {
  return {.name = "plane_tolerance_m",
          .slot = at(&Config::scene, &SceneConfig::plane_tolerance_m),
          .unit = "m",
          .range = {0, 1},
          .doc =
              "Vertices of the scene and of vehicle meshes within this distance of a common plane are one surface, "
              "and are moved onto it, so that a wall with rounded or measured coordinates mirrors like one wall. "
              "Not given: a thirty-second of the wavelength, but at least 1 mm (closer vertices are merged anyway) "
              "and at most 2 mm, or a thousandth of a smaller scene. "
              "A mesh in float32 far away from its origin gets more: the step of its largest coordinate. "
              "`wavetracer scene info` says how much was moved. 0 moves nothing.",
          .example = "0.006"};
}

}  // namespace

Table scene_table() {
  const auto s = [](auto member) { return at(&Config::scene, member); };
  return {.name = "scene",
          .doc = "The static scene. Give either file or generate.",
          .fields = {
              {.name = "file",
               .slot = s(&SceneConfig::file),
               .form = Form::input_file,
               .doc = "Mitsuba XML with PLY or OBJ meshes, or one OBJ, GLB, glTF or PLY file."},
              {.name = "generate",
               .slot = s(&SceneConfig::generate),
               .doc = "A generated city instead of a file: the options of `wavetracer scene city`.",
               .example = "\"--seed 1 --blocks 4\"",
               .needed = true},
              {.name = "scale",
               .slot = s(&SceneConfig::scale),
               .unit = "metres per file unit",
               .range = {0, 1e6, true},
               .doc = "For OBJ, GLB, glTF and PLY files. OBJ and PLY files do not state their unit; "
                      "1 reads them in metres, which is also the unit of glTF."},
              {.name = "up",
               .slot = s(&SceneConfig::up),
               .doc = "The axis of the file that points up. auto: y for GLB and glTF, as their standard says, "
                      "and z for all other formats."},
              {.name = "default_material",
               .slot = s(&SceneConfig::default_material),
               .doc = "Radio material of meshes that name none. If this is empty, a mesh without a material is "
                      "an error, because a guess could be wrong without anybody noticing."},
              {.name = "itu_edition",
               .slot = s(&SceneConfig::itu_edition),
               .doc = "The edition of Recommendation ITU-R P.2040 whose materials are known by name. "
                      "P.2040-4 (09/2025) has all materials of P.2040-3 (08/2023) with the same values, "
                      "four new ones and laws above 100 GHz; `wavetracer scene materials` lists them "
                      "with their ranges."},
              {.name = "extrapolate_materials",
               .slot = s(&SceneConfig::extrapolate_materials),
               .doc = "The treatment of a material that is not known at the carrier. false: it is an error. "
                      "true: its law of the nearest range is used, with a warning; "
                      "ITU-R P.2040 calls the ranges indicative. "
                      "The three kinds of ground stay an error, because for them the range is a limit."},
              plane_tolerance_field(),
              {.name = "streets",
               .slot = s(&SceneConfig::streets),
               .form = Form::input_file,
               .doc = "The road network of the scene, for pictures only: the viewer draws its lanes. "
                      "A network of SUMO (.net.xml, plain or compressed with gzip), "
                      "in the coordinates of trajectories.file. "
                      "Generated cities need none.",
               .example = "\"town.net.xml\""},
              {.name = "material_alias",
               .slot = s(&SceneConfig::material_alias),
               .doc = "Pairs of a material name in the scene file and the radio material that it means, for names "
                      "that are not materials of ITU-R P.2040.",
               .example = "{ \"my wall\" = \"concrete\" }"},
          }};
}

Table material_table() {
  const auto m = [](auto member) { return at(&Config::materials, member); };
  return {
      .name = "material",
      .doc =
          "A radio material, which replaces one of ITU-R P.2040 or is added to them. Give either a, b, "
          "c and d, or permittivity and conductivity_s_m.",
      .fields =
          {
              {.name = "name",
               .slot = m(&MaterialConfig::name),
               .required = true,
               .doc = "The name that the scene uses, or that scene.material_alias gives.",
               .example = "\"concrete\""},
              {.name = "library",
               .slot = m(&MaterialConfig::library),
               .doc = "The material of ITU-R P.2040 that it is based on, under a name of your own: its law "
                      "and range hold, except for what the other keys say. Not given: the one of its own name, "
                      "if there is one.",
               .example = "\"concrete\""},
              {.name = "a",
               .slot = m(&MaterialConfig::a),
               .range = {0, 1e6, true},
               .doc = "Factor of the relative permittivity a f^b, with f in GHz (ITU-R P.2040, Table 3).",
               .example = "5.24"},
              {.name = "b",
               .slot = m(&MaterialConfig::b),
               .range = {-10, 10},
               .doc = "Exponent of the relative permittivity a f^b.",
               .example = "0.0"},
              {.name = "c",
               .slot = m(&MaterialConfig::c),
               .unit = "S/m",
               .range = {0, 1e12},
               .doc = "Factor of the conductivity c f^d, with f in GHz (ITU-R P.2040, Table 3).",
               .example = "0.0462"},
              {.name = "d",
               .slot = m(&MaterialConfig::d),
               .range = {-10, 10},
               .doc = "Exponent of the conductivity c f^d.",
               .example = "0.7822"},
              {.name = "permittivity",
               .slot = m(&MaterialConfig::permittivity),
               .range = {1, 1e6},
               .doc = "Relative permittivity at every frequency, instead of a and b.",
               .example = "5.24"},
              {.name = "conductivity_s_m",
               .slot = m(&MaterialConfig::conductivity_s_m),
               .unit = "S/m",
               .range = {0, 1e12},
               .doc = "Conductivity at every frequency, instead of c and d.",
               .example = "0.185"},
              {.name = "thickness_m",
               .slot = m(&MaterialConfig::thickness_m),
               .unit = "m",
               .range = {0, infinity, true},
               .doc = "Thickness of the slab; inf is a half space, "
                      "and so is a slab thicker than 2^44 radians. "
                      "Not given: the thickness in the scene file, or 0.1 m if it has none.",
               .example = "0.3"},
              {.name = "layers",
               .slot = m(&MaterialConfig::layers),
               .range = {0, infinity, true},
               .doc = "A wall of several layers, from its outer side inwards, instead of a law and a thickness: "
                      "for each layer a material without layers, by its name here or in ITU-R P.2040, and its "
                      "thickness in m. The outer side of a closed body is its outside; that of an open sheet is "
                      "the side from which the corners of its triangles run counter-clockwise.",
               .example = "[{ material = \"brick\", thickness_m = 0.12 }, "
                          "{ material = \"concrete\", thickness_m = 0.2 }]"},
              {.name = "scattering",
               .slot = m(&MaterialConfig::scattering),
               .range = {0, 1},
               .doc = "Scattering coefficient S, used with trace.scattering: "
                      "the share S^2 of the reflected power is scattered in all directions, "
                      "and the specular reflection keeps the rest (Degli-Esposti et al., 2007). "
                      "Vegetation scatters the share S^2 of the power that it absorbs, "
                      "evenly over all directions. Not given: 0.",
               .example = "0.4"},
              {.name = "scattering_lobe",
               .slot = m(&MaterialConfig::scattering_lobe),
               .range = {0, 50},
               .doc = "Exponent of the scattering lobe around the specular direction, an integer; "
                      "4 is usual for walls. 0: no lobe, scattering by Lambert's law, "
                      "which sends all of the share S^2. A lobe sends less of it, so that both directions "
                      "of a path are alike: with 4 it sends 77, 80, 82 and 91 % at 0, 45, "
                      "60 and 80 degrees of incidence (docs/limits.md).",
               .example = "4"},
              {.name = "scattering_cross_polar",
               .slot = m(&MaterialConfig::scattering_cross_polar),
               .range = {0, 1},
               .doc = "Share of the scattered power that is in the other (cross) polarisation.",
               .example = "0.1"},
              {.name = "vegetation",
               .slot = m(&MaterialConfig::vegetation),
               .doc = "Leaves and twigs instead of a surface: closed meshes of this material are volumes "
                      "that take power per metre inside, A_m (1 - exp(-g d / A_m)) "
                      "dB on d metres (ITU-R P.833-10, "
                      "equation 1). mixed, deciduous: the wood in which A_m was measured. "
                      "The keys about permittivity, thickness and scattering_lobe do not apply.",
               .example = "\"mixed\""},
              {.name = "in_leaf",
               .slot = m(&MaterialConfig::in_leaf),
               .doc =
                   "Only for vegetation: with leaves. Without them it takes less per metre: a sixth less up to 1 GHz, "
                   "63% less at 5.9 GHz and 76% less at 30 GHz."},
              {.name = "attenuation_db_m",
               .slot = m(&MaterialConfig::attenuation_db_m),
               .unit = "dB/m",
               .range = {0, 100},
               .doc = "Only for vegetation: g. Not given: 0.2 dB/m at 1 GHz, "
                      "in proportion to the frequency (read off Figure 2 of ITU-R P.833-10, 30 MHz to 30 GHz).",
               .example = "1.0"},
              {.name = "max_attenuation_db",
               .slot = m(&MaterialConfig::max_attenuation_db),
               .unit = "dB",
               .range = {0, infinity},
               .doc = "Only for vegetation: A_m, the most that a path loses in this material; inf: no maximum. "
                      "Not given: 1.37 f^0.42 (mixed) or 0.18 f^0.752 (deciduous), f in MHz.",
               .example = "30.0"},
          },
      .append = append<&Config::materials>,
      .count = count<&Config::materials>,
      .optional = true};
}

Table transmitter_table() {
  return ends_table<&Config::transmitters>(
      "transmitter",
      "An antenna that sends; one table per transmitter. At least one is needed, unless there is a [[station]] "
      "or a [[mount]] that transmits.",
      "\"rsu\"", "[0.0, 0.0, 6.0]");
}

Table receiver_table() {
  return ends_table<&Config::receivers>("receiver",
                                        "An antenna that receives; one table per receiver. At least one is needed, "
                                        "unless there is a [[station]], a [[receiver_grid]] or a [[mount]] "
                                        "that receives.",
                                        "\"car\"", "[40.0, 0.0, 1.5]");
}

Table station_table() {
  return ends_table<&Config::stations>(
      "station",
      "An antenna that sends and receives, as that of a road-side unit; one table per station. "
      "It is one radio with one name: a transmitter after those of [[transmitter]], and a receiver after those "
      "of [[receiver]].",
      "\"rsu\"", "[0.0, 0.0, 6.0]", true);
}

}  // namespace wavetracer::config
