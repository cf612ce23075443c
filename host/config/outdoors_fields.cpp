// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about media that attenuate a wave without turning it: the air and vegetation.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {

Table air_table() {
  const auto a = [](auto member) { return at(&Config::air, member); };
  return {.name = "air",
          .doc =
              "Attenuation of every path by the air, per metre of its length; the weather is the same everywhere. "
              "By default there is none, and nothing is computed. See docs/outdoors.md.",
          .fields = {
              {.name = "rain_mm_h",
               .slot = a(&AirConfig::rain_mm_h),
               .unit = "mm/h",
               .range = {0, 250},
               .doc = "Rain rate. The specific attenuation is that of ITU-R P.838-3, from 1 GHz on. It depends on the "
                      "elevation of each leg, and is different for vertical and horizontal waves. "
                      "5 is steady rain, 25 heavy rain, "
                      "100 a cloudburst."},
              {.name = "fog_g_m3",
               .slot = a(&AirConfig::fog_g_m3),
               .unit = "g/m3",
               .range = {0, 10},
               .doc = "Liquid water of fog or cloud. Specific attenuation by ITU-R P.840-8, up to 200 GHz. "
                      "0.05 is fog in which one sees about 300 m, 0.5 one in which one sees about 50 m."},
              {.name = "gases",
               .slot = a(&AirConfig::gases),
               .doc = "Attenuation by oxygen and water vapour, by ITU-R P.676-13 line by line, from 1 GHz on. "
                      "At 5.9 GHz it is 0.01 dB/km, at 60 GHz 15 dB/km."},
              {.name = "temperature_c",
               .slot = a(&AirConfig::temperature_c),
               .unit = "degrees Celsius",
               .range = {-80, 60},
               .doc = "Temperature of the air and of fog."},
              {.name = "pressure_hpa",
               .slot = a(&AirConfig::pressure_hpa),
               .unit = "hPa",
               .range = {10, 1100},
               .doc = "Pressure of the air with its water vapour, as a barometer shows it. Only for gases."},
              {.name = "humidity_g_m3",
               .slot = a(&AirConfig::humidity_g_m3),
               .unit = "g/m3",
               .range = {0, 100},
               .doc = "Density of water vapour. Only for gases. 7.5 is the reference of ITU-R P.676, "
                      "59% relative humidity at 15 degrees."},
          }};
}

Table vegetation_table() {
  const auto v = [](auto member) { return at(&Config::vegetation, member); };
  return {.name = "vegetation",
          .doc =
              "A volume of leaves and twigs, such as the crown of a tree or a hedge: waves pass it "
              "and lose power per metre inside (ITU-R P.833-10). It reflects nothing and stops no ray. "
              "Closed meshes of the scene whose material is vegetation are the same. See docs/outdoors.md.",
          .fields =
              {
                  {.name = "shape",
                   .slot = v(&VegetationConfig::shape),
                   .doc = "The shape inside the box of size_m: the box itself, an upright cylinder, or a spheroid."},
                  {.name = "centre_m",
                   .slot = v(&VegetationConfig::centre_m),
                   .unit = "m",
                   .range = places,
                   .required = true,
                   .doc = "x, y, z of the middle in the coordinates of the scene file.",
                   .example = "[20.0, 4.0, 6.0]"},
                  {.name = "size_m",
                   .slot = v(&VegetationConfig::size_m),
                   .unit = "m",
                   .range = places,
                   .required = true,
                   .doc = "Size along x, y and z, before the rotation by yaw_deg.",
                   .example = "[5.0, 5.0, 7.0]"},
                  {.name = "yaw_deg",
                   .slot = v(&VegetationConfig::yaw_deg),
                   .unit = "degrees",
                   .range = angles,
                   .doc = "The turn about z."},
                  {.name = "material",
                   .slot = v(&VegetationConfig::material),
                   .doc = "\"vegetation\", \"deciduous_vegetation\", or a [[material]] with the key vegetation."},
              },
          .append = append<&Config::vegetation>,
          .count = count<&Config::vegetation>,
          .optional = true};
}

}  // namespace wavetracer::config
