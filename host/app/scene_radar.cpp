// SPDX-License-Identifier: Apache-2.0
// `wavetracer scene radar` prints what a body sends back by physical optics (docs/radar.md), as a table in CSV: radar
// cross sections over azimuths, or its echoes between two places. It needs no device.
#include "app/scene_radar.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include "app/number_range.hpp"
#include "base/csv.hpp"
#include "bodies/physical_optics.hpp"
#include "radio/constants.hpp"
#include "scene/load.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

struct RadarOptions {
  std::string file, up = "auto", default_material = "metal";
  double scale = 1, frequency_hz = 77e9, elevation_deg = 0;
  std::vector<double> azimuths_deg = {0, 360, 1};  // first, last, step
  std::optional<double> transmitter_azimuth_deg;
  std::vector<double> transmitter_m, receiver_m;
  PhysicalOptics optics;
};

glm::dvec3 direction_of(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * M_PI / 180, elevation = elevation_deg * M_PI / 180;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

std::string cross_section_table(const ScatteringBody& body, const RadarOptions& options) {
  const double first = options.azimuths_deg[0], last = options.azimuths_deg[1], step = options.azimuths_deg[2];
  if (!(step > 0) || !(last >= first) || !((last - first) / step < 1e6))
    throw ConfigError(
        fmt::format("--azimuths {}: give a first angle, a last one that is not less, and a step above 0 that "
                    "makes fewer than a million rows",
                    fmt::join(options.azimuths_deg, ",")));
  Csv table({"azimuth_deg", "theta_theta_dbsm", "theta_phi_dbsm", "phi_theta_dbsm", "phi_phi_dbsm"});
  const auto count = static_cast<size_t>(std::floor((last - first) / step + 1e-9)) + 1;
  for (size_t i = 0; i < count; ++i) {
    const double azimuth = first + static_cast<double>(i) * step;
    const glm::dvec3 receiver = direction_of(azimuth, options.elevation_deg);
    const glm::dvec3 transmitter =
        direction_of(options.transmitter_azimuth_deg.value_or(azimuth), options.elevation_deg);
    const auto sections = body.cross_sections_m2(transmitter, receiver, options.frequency_hz, options.optics);
    const auto db = [&](size_t k) { return std::round(1e4 * 10 * std::log10(sections[k])) / 1e4; };
    table.add(azimuth, db(0), db(1), db(2), db(3));
  }
  return table.text();
}

std::string echo_table(const ScatteringBody& body, const RadarOptions& options) {
  const auto place = [](const std::vector<double>& p) { return glm::dvec3(p[0], p[1], p[2]); };
  const glm::dvec3 transmitter = place(options.transmitter_m), receiver = place(options.receiver_m);
  Csv table({"bounces", "delay_s", "theta_theta_re", "theta_theta_im", "theta_phi_re", "theta_phi_im", "phi_theta_re",
             "phi_theta_im", "phi_phi_re", "phi_phi_im", "first_x_m", "first_y_m", "first_z_m", "last_x_m", "last_y_m",
             "last_z_m", "facets"});
  const double at_1_m = speed_of_light_m_s / options.frequency_hz / (4 * M_PI);
  for (const Echo& echo : body.scattered(transmitter, receiver, options.frequency_hz, options.optics)) {
    std::array<std::complex<double>, 4> a = echo.matrix;
    for (std::complex<double>& value : a) value *= at_1_m;
    const glm::dvec3 first = echo.vertices.front(), last = echo.vertices.back();
    table.add(echo.facets.size(), echo.length_m / speed_of_light_m_s, a[0].real(), a[0].imag(), a[1].real(),
              a[1].imag(), a[2].real(), a[2].imag(), a[3].real(), a[3].imag(), first.x, first.y, first.z, last.x,
              last.y, last.z, fmt::format("{}", fmt::join(echo.facets, " ")));
  }
  return table.text();
}

void print_radar(const RadarOptions& options) {
  if (options.transmitter_m.empty() != options.receiver_m.empty())
    throw ConfigError("--transmitter and --receiver belong together: give both for echoes, or none for cross sections");
  SceneConfig config;
  config.file = options.file;
  config.scale = options.scale;
  config.up = UpAxis::named(options.up);
  config.default_material = options.default_material;
  const Scene scene = load_scene_file(options.file, config, {}, options.frequency_hz);
  const ScatteringBody body(body_of(scene, options.frequency_hz));
  std::cout << (options.transmitter_m.empty() ? cross_section_table(body, options) : echo_table(body, options));
}

}  // namespace

void add_radar(CLI::App& scene) {
  CLI::App* command = scene.add_subcommand(
      "radar", "Print radar cross sections or echoes of a body in a scene file, by physical optics, as CSV");
  const auto options = std::make_shared<RadarOptions>();
  command->add_option("file", options->file, "Scene file (XML, OBJ, GLB, glTF, PLY)")->required();
  command->add_option("--frequency", options->frequency_hz, "Frequency in Hz")
      ->check(number_range(1e6, 1e12))
      ->capture_default_str();
  command->add_option("--scale", options->scale, "Metres per file unit, like the key scene.scale")
      ->check(positive_number());
  command->add_option("--up", options->up, "Axis of the file that points up, like the key scene.up")
      ->check(CLI::IsMember(std::vector<std::string>(UpAxis::words.begin(), UpAxis::words.end())));
  command
      ->add_option("--default-material", options->default_material,
                   "Radio material of meshes that name none, like the key scene.default_material")
      ->capture_default_str();
  command
      ->add_option("--azimuths", options->azimuths_deg,
                   "First azimuth, last azimuth and step in degrees, separated by commas; 0,360,1 if not given")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--elevation", options->elevation_deg, "Elevation of both ends in degrees")
      ->check(number_range(-90.0, 90.0))
      ->capture_default_str();
  command->add_option("--transmitter-azimuth", options->transmitter_azimuth_deg,
                      "Azimuth of the transmitter in degrees; that of the receiver if not given");
  command
      ->add_option("--transmitter", options->transmitter_m,
                   "x,y,z of a transmitter in metres: print echoes between two places instead")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--receiver", options->receiver_m, "x,y,z of the receiver of these echoes in metres")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--echo-size", options->optics.echo_size_m, "Largest part of a facet in one echo, in metres")
      ->check(positive_number());
  command->add_option("--bounces", options->optics.max_bounces, "Largest number of facets that a wave meets")
      ->check(number_range(1u, 5u))
      ->capture_default_str();
  command->add_flag("--reciprocal", options->optics.reciprocal, "Take the mean with the way back");
  command->callback([options] { print_radar(*options); });
}

}  // namespace wavetracer::app
