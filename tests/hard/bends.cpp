// SPDX-License-Identifier: Apache-2.0
// Bent surfaces, by microradians or by half a turn, inwards and outwards: the total field must not jump where the
// reflection of one face ends and that of the other begins, nor where a corner reflects once more.
#include <glm/trigonometric.hpp>

#include "hard/responses.hpp"

namespace wavetracer::test {
namespace {

struct Bend {
  double exterior_deg;  // angle of the free space between the faces
  std::string material = "metal";
  double hz = frequency_hz;
  double scale = 1;    // factor of all lengths; 1: the source stands 8 m from the edge, receivers 5 m
  bool lying = false;  // a horizontal edge
};

// Azimuth from face 0 on, about the edge, which is turned so that nothing is round in float32.
glm::dvec3 about_edge(const Bend& bend, double rho_m, double azimuth_rad, double along_m) {
  const double turned_rad = 0.37, x = std::cos(azimuth_rad + turned_rad), y = std::sin(azimuth_rad + turned_rad);
  const glm::dvec3 p =
      bend.lying ? glm::dvec3{rho_m * x, along_m, rho_m * y} : glm::dvec3{rho_m * x, rho_m * y, along_m};
  return bend.scale * p;
}

std::vector<Quad> faces_of(const Bend& bend) {
  std::vector<Quad> faces;
  for (const double azimuth_rad : {0.0, glm::radians(bend.exterior_deg)})
    faces.push_back({about_edge(bend, 0, 0, -60), about_edge(bend, 30, azimuth_rad, 0), about_edge(bend, 0, 0, 120)});
  return faces;
}

Config traced(const Bend& bend, const SceneFile& file, const Points& transmitters, const Points& receivers) {
  Config config = config_of(file.path(), transmitters, receivers, 20000, 5);
  config.radio.frequency_hz = bend.hz;
  config.scene.extrapolate_materials = true;  // concrete below 1 GHz
  config.trace.diffraction = true;
  config.trace.diffraction_rays = 2000;
  return config;
}

// Returns where waves of up to five reflections end, for a source at this azimuth: unfolded, a wave is a straight line
// past the edge, and receivers are at its end if their azimuths, unfolded, are pi from the source's.
std::vector<double> boundaries_of(double in_rad, double exterior_rad) {
  std::vector<double> out;
  for (int turns = 0; turns <= 2; ++turns)
    for (const double azimuth_rad : {pi - in_rad - 2 * turns * exterior_rad, 2 * turns * exterior_rad - pi - in_rad,
                                     in_rad + pi - 2 * turns * exterior_rad, in_rad - pi + 2 * turns * exterior_rad})
      if (azimuth_rad > 0.02 && azimuth_rad < exterior_rad - 0.02) out.push_back(azimuth_rad);
  return out;
}

std::string name_of(const Bend& bend) {
  const double bent_mrad = 1e3 * glm::radians(bend.exterior_deg - 180);
  return fmt::format("{}, {}, {} GHz, source at {} m{}",
                     std::abs(bent_mrad) < 20 ? fmt::format("bend of {:.4g} mrad", bent_mrad)
                                              : fmt::format("faces {:.4g} degrees apart", bend.exterior_deg),
                     bend.material, bend.hz / 1e9, 8 * bend.scale, bend.lying ? ", lying" : "");
}

HardCase across_boundaries(const std::string& device, const Bend& bend, double in_part, double tolerance) {
  const double exterior_rad = glm::radians(bend.exterior_deg), in_rad = in_part * exterior_rad;
  const std::vector<double> at_m = boundary_steps(bend.hz), boundaries = boundaries_of(in_rad, exterior_rad);
  Points receivers;
  for (const double azimuth_rad : boundaries)
    for (const double step_m : at_m)
      receivers.push_back(about_edge(bend, 5, azimuth_rad + step_m / (5 * bend.scale), -1));
  const SceneFile file({Part{faces_of(bend), bend.material}});
  const Paths paths = run(traced(bend, file, {about_edge(bend, 8, in_rad, 3)}, receivers), device).paths;
  const std::vector<Response> h = responses_at(bend.hz, paths, 0, receivers.size());
  HardCase out{name_of(bend), "the total field is continuous where reflections end, V and H",
               boundaries.empty() ? std::numeric_limits<double>::infinity() : 0, tolerance, "of the field"};
  for (size_t b = 0; b < boundaries.size(); ++b) {
    const size_t first = b * at_m.size(), last = first + at_m.size() - 1;
    for (const size_t port : {0, 1}) out.measured = std::max(out.measured, boundary_jump(at_m, h, first, port));
    // A wave must end there, or this is no boundary; for a slight bend, the other face's wave begins there.
    const bool slight = std::abs(exterior_rad - pi) < 0.01;
    if (!slight && bend.exterior_deg != 90 &&
        geometrical_paths(paths, 0, static_cast<uint32_t>(first)) ==
            geometrical_paths(paths, 0, static_cast<uint32_t>(last)))
      out.measured = std::numeric_limits<double>::infinity();
  }
  return out;
}

// Sums what both faces reflect and the edge diffracts, in steps of a centimetre through the mirror image of a source
// that is 110 m away: of a plane wall it would be the image.
HardCase along_a_line(const std::string& device, double bent_rad, bool lying) {
  const double c = std::cos(bent_rad), s = std::sin(bent_rad);
  const auto turned = [&](double x, double y, double z) { return lying ? glm::dvec3{x, z, -y} : glm::dvec3{x, y, z}; };
  const SceneFile file({Quad{turned(-200, 0, -50), turned(200, 0, 0), turned(0, 0, 100)},
                        Quad{turned(0, 0, -50), turned(200 * c, 200 * s, 0), turned(0, 0, 100)}});
  Points receivers;
  for (int i = -60; i <= 60; ++i) receivers.push_back(turned(100 + 0.01 * i, -50, 0.1));
  const Paths paths = run(traced({}, file, {turned(-100, -50, 0)}, receivers), device).paths;
  std::vector<Complex> field(receivers.size());
  for (size_t i = 0; i < paths.size(); ++i)
    if (!kinds_of(paths, i).empty())
      field[paths.rx[i]] += paths.a[i][0] * std::polar(1.0, -2 * pi * frequency_hz * paths.delay_s[i]);
  HardCase out{fmt::format("wall bent by {:.4g} mrad{}", 1e3 * bent_rad, lying ? ", a road" : ""),
               "steps of a centimetre along a line, of the mirrored field", 0, 0.05, "of the field"};
  const double mirrored = friis(std::hypot(200, 100));
  for (size_t i = 1; i < field.size(); ++i)
    out.measured = std::max(out.measured, std::abs(std::abs(field[i]) - std::abs(field[i - 1])) / mirrored);
  for (const Complex& here : field)
    if (!(std::abs(here) > 0.7 * mirrored)) out.measured = std::numeric_limits<double>::infinity();
  return out;
}

// The diffracted wave of a corner that is left out must be weak.
HardCase left_out(const std::string& device, const Bend& bend) {
  const double exterior_rad = glm::radians(bend.exterior_deg);
  Points receivers;
  for (int i = 1; i < 400; ++i) receivers.push_back(about_edge(bend, 5, exterior_rad * i / 400, -1));
  const SceneFile file({Part{faces_of(bend), bend.material}});
  const Paths paths = run(traced(bend, file, {about_edge(bend, 8, 0.23 * exterior_rad, 3)}, receivers), device).paths;
  const double shortest_m = 14 * bend.scale;  // over the edge; paths over the rims 30 m away are longer
  std::vector<double> diffracted(receivers.size(), 0);
  for (size_t i = 0; i < paths.size(); ++i) {
    const double length_m = paths.delay_s[i] * speed_of_light;
    if (kinds_of(paths, i) != "D" || length_m > shortest_m) continue;
    double square = 0;
    for (const Complex& a : paths.a[i]) square += std::norm(a);
    diffracted[paths.rx[i]] = std::sqrt(square / 2) / (speed_of_light / bend.hz / (4 * pi * length_m));
  }
  HardCase out{name_of(bend), "where the wave of the edge ends, of a wave in free space", 0, 0.03, "of it"};
  size_t without = 0;
  for (size_t i = 0; i < diffracted.size(); ++i) {
    without += diffracted[i] == 0;
    for (const size_t beside : {i - 1, i + 1})
      if (diffracted[i] == 0 && beside < diffracted.size()) out.measured = std::max(out.measured, diffracted[beside]);
  }
  if (without == 0 || without == diffracted.size()) out.measured = std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace

HardCases bends(const std::string& device) {
  HardCases cases;
  const auto bent = [](double mrad) { return 180 + glm::degrees(1e-3 * mrad); };
  std::vector<Bend> all;
  for (const double mrad : {1e-5, 1e-3, 1e-2, 0.1, 0.9, 5.0})
    for (const double sign : {1.0, -1.0}) all.push_back({bent(sign * mrad)});
  for (const double exterior_deg : {50, 70, 100, 120, 150, 170, 179, 181, 190})
    for (const char* material : {"metal", "concrete"}) all.push_back({exterior_deg, material});
  for (const double exterior_deg : {120.0, bent(0.5), bent(-0.5), 270.0})
    for (const double hz : other_bands_hz) all.push_back({exterior_deg, "concrete", hz});
  for (const double exterior_deg : {bent(-2), bent(2), 150.0}) {
    all.push_back({exterior_deg, "concrete", frequency_hz, 1, true});
    all.push_back({exterior_deg, "metal", frequency_hz, 0.05});
    all.push_back({exterior_deg, "metal", frequency_hz, 30});
  }
  for (const Bend& bend : all) cases.push_back(across_boundaries(device, bend, 0.31, 1e-4));
  cases.push_back(across_boundaries(device, {90, "metal"}, 0.31, 1e-3));
  for (const double mrad : {0.0, 0.01, 0.1, 0.5, 0.9, 2.0, 5.0})
    for (const double sign : {1.0, -1.0}) cases.push_back(along_a_line(device, 1e-3 * sign * mrad, false));
  for (const double mrad : {0.5, -0.5}) cases.push_back(along_a_line(device, 1e-3 * mrad, true));
  for (const double exterior_deg : {120.0, 150.0})
    for (const char* material : {"metal", "concrete"})
      cases.push_back(left_out(device, {exterior_deg, material, 28e9, 10}));
  return cases;
}

}  // namespace wavetracer::test
