// SPDX-License-Identifier: Apache-2.0
// Rows of the field table about antenna arrays and the responses between their elements.
// The doc of each row gives the reason for its default; the default itself is the initialiser in config.hpp.
#include "config/field_rows.hpp"

namespace wavetracer::config {
namespace {

Field codebook_field() {
  return {.name = "codebook",
          .slot = at(&Config::arrays, &ArrayConfig::codebook),
          .choices = {NamedCodebook::words.begin(), NamedCodebook::words.end()},
          .form = Form::choice_or_file,
          .doc =
              "Beams whose gains are written for each link: the best beams into links.csv, all into beams.h5. "
              "none: no beams. dft: rows x columns orthogonal beams of a panel. "
              "Or a file: CSV with the columns beam,element,re,im, one row per weight; "
              "beams and elements count from 0, and weights that are not given are 0. "
              "The weights of a beam are scaled so that their powers add up to 1."};
}

}  // namespace

Field frequencies_field() {
  return {.name = "frequencies_hz",
          .slot = at(&Config::radio, &RadioConfig::frequencies_hz),
          .unit = "Hz",
          .range = {1e6, 1e12},
          .doc =
              "Several carriers in one run, instead of frequency_hz: paths are found once, "
              "and their coefficients are computed for each carrier. The first is the carrier of paths.h5, "
              "links.csv, plots and exports; all of them are in carriers.h5 and responses.h5. "
              "Empty: frequency_hz alone.",
          .example = "[5.9e9, 28e9]"};
}

Field wavefront_field() {
  return {.name = "wavefront",
          .slot = at(&Config::radio, &RadioConfig::wavefront),
          .doc =
              "The wavefront across the elements of an [[array]]. "
              "spherical: each path has its exact length between every two elements, "
              "which also holds in the near field of large arrays. plane: the phase follows from the directions of "
              "the path at the centres of both arrays, as in most channel models."};
}

Table array_table() {
  const auto a = [](auto member) { return at(&Config::arrays, member); };
  const auto spacing = [&](std::string name, auto member, std::string between, std::string unit, std::string doc,
                           std::string example) {
    return Field{.name = std::move(name),
                 .slot = a(member),
                 .unit = std::move(unit),
                 .range = {0, 1e6, true},
                 .doc = "Distance between the centres of " + std::move(between) + ". " + std::move(doc),
                 .example = std::move(example)};
  };
  const std::string half = "Half a wavelength is usual, because the main lobe then has no copies (grating lobes).",
                    instead = "Instead of the spacing in wavelengths.";
  return {.name = "array",
          .doc =
              "Places of the elements of antenna arrays: a panel of rows and columns, or positions. "
              "Antennas refer to an array by its name; their position is its centre. "
              "Paths are computed between the centres; responses.h5, "
              "beams and the library have them between elements.",
          .fields =
              {
                  {.name = "name",
                   .slot = a(&ArrayConfig::name),
                   .required = true,
                   .doc = "The name that the key array of antennas refers to; unique.",
                   .example = "\"panel\""},
                  {.name = "rows",
                   .slot = a(&ArrayConfig::rows),
                   .unit = "elements",
                   .range = {1, 1024},
                   .doc = "Elements of a column, along z of the antenna's axes. "
                          "Elements are numbered column by column from -y to +y, and in each from the top down."},
                  {.name = "columns",
                   .slot = a(&ArrayConfig::columns),
                   .unit = "elements",
                   .range = {1, 1024},
                   .doc = "Elements of a row, along y of the antenna's axes: the panel faces +x."},
                  spacing("vertical_spacing_wavelengths", &ArrayConfig::vertical_spacing_wavelengths, "rows",
                          "wavelengths of radio.frequency_hz", half, ""),
                  spacing("horizontal_spacing_wavelengths", &ArrayConfig::horizontal_spacing_wavelengths, "columns",
                          "wavelengths of radio.frequency_hz", half, ""),
                  spacing("vertical_spacing_m", &ArrayConfig::vertical_spacing_m, "rows", "m", instead, "0.025"),
                  spacing("horizontal_spacing_m", &ArrayConfig::horizontal_spacing_m, "columns", "m", instead, "0.025"),
                  {.name = "positions_m",
                   .slot = a(&ArrayConfig::positions_m),
                   .unit = "m",
                   .range = places,
                   .doc = "Instead of a panel: the position of each element relative to the antenna's position, "
                          "in the axes of the antenna (x: boresight, y: left, z: up).",
                   .example = "[[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]]"},
                  codebook_field(),
              },
          .append = append<&Config::arrays>,
          .count = count<&Config::arrays>,
          .optional = true};
}

Table response_table() {
  const auto r = [](auto member) { return at(&Config::response, member); };
  return {.name = "response",
          .doc =
              "The channel in the frequency domain (CFR, channel frequency response): with bandwidth_hz, "
              "responses.h5 has H at every subcarrier, for every pair of antenna elements and ports of each link.",
          .fields = {
              {.name = "bandwidth_hz",
               .slot = r(&ResponseConfig::bandwidth_hz),
               .unit = "Hz",
               .range = {0, 1e12},
               .none = "0",
               .doc = "The band, of which the subcarriers take equal parts. 0: no responses are computed."},
              {.name = "subcarriers",
               .slot = r(&ResponseConfig::subcarriers),
               .range = {1, 1048576},
               .doc = "The number N of subcarriers. Subcarrier k is k * bandwidth_hz / N away from the carrier, "
                      "with k from -floor(N / 2) on, as in OFDM."},
              {.name = "times",
               .slot = r(&ResponseConfig::times),
               .range = {1, 1048576},
               .doc = "Times within each frame, the first of which is that of the frame. "
                      "Over them paths keep their coefficients, and phases turn by their Doppler shifts; "
                      "an OFDM slot has 14."},
              {.name = "time_step_s",
               .slot = r(&ResponseConfig::time_step_s),
               .unit = "s",
               .range = {0, 3600, true},
               .doc = "Only with more than one time: the interval between times."},
          }};
}

}  // namespace wavetracer::config
