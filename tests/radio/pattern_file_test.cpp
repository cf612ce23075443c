// SPDX-License-Identifier: Apache-2.0
// Pattern files: the values of a valid one between its grid points, and the messages about invalid ones.
// Files are written into the build folder.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "folders.hpp"
#include "radio/antenna.hpp"
#include "radio/world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using test::radians;

namespace {

const std::string header = "theta_deg,phi_deg,v_re,v_im,h_re,h_im\n";

// A file that is removed when its test ends.
struct PatternFile {
  std::string path = test::build_folder() + "/pattern_file_test.csv";
  explicit PatternFile(const std::string& text) { std::ofstream(path) << text; }
  ~PatternFile() { std::filesystem::remove(path); }
};

// v = theta + j phi / 100, h = -theta j on a grid of 45 by 90 degrees.
std::string grid_text(double first_phi, bool closed) {
  std::string text = "# a made-up pattern\n\n" + header;
  for (int theta = 0; theta <= 180; theta += 45) {
    for (int k = 0; k < (closed ? 5 : 4); ++k) {
      const double phi = first_phi + 90 * k, value = 90 * (k % 4);
      text += std::to_string(theta) + ", " + std::to_string(phi) + "," + std::to_string(theta) + "," +
              std::to_string(value / 100) + ",0," + std::to_string(-theta) + "\r\n";
    }
  }
  return text;
}

// The field of the pattern of a file in a direction of its own frame, as devices interpolate it.
FieldPair field_at(const std::string& file, double theta_rad, double phi_rad) {
  const PatternGrid grid = load_pattern(file);
  const Antenna antenna(WT_PATTERN_GRID, grid, {0}, glm::dmat3(1.0));
  const auto f = device::wt_grid_pattern(&antenna.record(), antenna.samples().data(), {theta_rad, phi_rad});
  return {{f.theta.x, f.theta.y}, {f.phi.x, f.phi.y}};
}

std::string error_of(const std::string& text) {
  const PatternFile file(text);
  try {
    load_pattern(file.path);
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).starts_with(file.path));
    return std::string(error.what()).substr(file.path.size());
  }
  return "no error";
}

}  // namespace

TEST_CASE("a pattern is interpolated bilinearly and wraps in phi") {
  for (const bool closed : {false, true}) {
    const PatternFile file(grid_text(0, closed));
    const auto same = [](std::complex<double> a, std::complex<double> b) { return std::abs(a - b) < 1e-9; };
    CHECK(same(field_at(file.path, 45 * radians, 90 * radians).theta, {45, 0.9}));
    CHECK(same(field_at(file.path, 60 * radians, 30 * radians).theta, {60, 0.3}));
    CHECK(same(field_at(file.path, 60 * radians, 30 * radians).phi, {0, -60}));
    CHECK(same(field_at(file.path, 0, 0).theta, {0, 0}));
    CHECK(same(field_at(file.path, std::numbers::pi, -std::numbers::pi).theta, {180, 1.8}));
    CHECK(same(field_at(file.path, 90 * radians, -45 * radians).theta, {90, 1.35}));  // half way from 270 to 360 = 0
    CHECK(same(field_at(file.path, 90 * radians, -1e-13).theta, {90, 0}));
  }
  const PatternFile shifted(grid_text(-180, true));
  CHECK(std::abs(field_at(shifted.path, 90 * radians, -90 * radians).theta - std::complex<double>{90, 0.9}) < 1e-9);
}

TEST_CASE("a pattern file serves as an antenna, turned and slanted like any other") {
  std::string text = header;
  for (int theta = 0; theta <= 180; theta += 90) {
    for (int phi = 0; phi < 360; phi += 120) {
      text += std::to_string(theta) + "," + std::to_string(phi) + ",0.6,0,0,0.8\n";
    }
  }
  const PatternFile file(text);
  const RadioEnd end = test::World::end({0, 0, 0}, file.path, "VH", {10, 20, 30});
  const Antenna antenna = make_antenna(end);
  REQUIRE(antenna.ports() == 2);
  std::complex<double> overlap = 0;
  for (uint32_t port = 0; port < 2; ++port) {
    const FieldPair f = antenna.field(port, glm::normalize(glm::dvec3{1, 2, -0.5}));
    CHECK(std::norm(f.theta) + std::norm(f.phi) == test::near(1, 1e-12));
  }
  const FieldPair v = antenna.field(0, {1, 0, 0}), h = antenna.field(1, {1, 0, 0});
  overlap = v.theta * h.theta + v.phi * h.phi;  // a turn by 90 degrees keeps the bilinear product 0
  CHECK(std::abs(overlap) < 1e-12);
}

TEST_CASE("errors of a pattern file name the file, the line and the fault") {
  CHECK(error_of("theta,phi\n") ==
        ":1: an antenna pattern begins with the header theta_deg,phi_deg,v_re,v_im,h_re,h_im");
  CHECK(error_of(header) == ": the antenna pattern has no rows");
  CHECK(error_of(header + "0,0,1,0,0\n") == ":2: a row needs six values: theta_deg,phi_deg,v_re,v_im,h_re,h_im");
  CHECK(error_of(header + "0,0,1,0,0,0,0\n") == ":2: a row needs six values: theta_deg,phi_deg,v_re,v_im,h_re,h_im");
  CHECK(error_of(header + "0,0,1,x,0,0\n") == ":2: \"x\" in column 4 is not a finite number");
  CHECK(error_of(header + "0,0,1,nan,0,0\n") == ":2: \"nan\" in column 4 is not a finite number");
  CHECK(error_of(header + "\n181,0,1,0,0,0\n") == ":3: theta_deg = 181 is not within 0 to 180");
  CHECK(error_of(header + "0,400,1,0,0,0\n") == ":2: phi_deg = 400 is not within -360 to 360");
  CHECK(error_of(header + "0,0,1,0,0,0\n0,360,2,0,0,0\n") == ":3: this direction has another value in line 2");
  CHECK(error_of(header + "0,0,1,0,0,0\n90,0,1,0,0,0\n") == ": theta_deg goes from 0 to 90; it must cover 0 to 180");
  CHECK(error_of(header + "0,0,1,0,0,0\n0,90,1,0,0,0\n180,0,1,0,0,0\n180,90,1,0,0,0\n") ==
        ": phi_deg = 90 is not on a regular grid: 2 values make steps of 180 degrees");
  CHECK(error_of(header + "0,0,1,0,0,0\n0,180,1,0,0,0\n180,0,1,0,0,0\n") ==
        ": the direction theta_deg = 180, phi_deg = 180 is missing from the grid");
  CHECK_THROWS_AS(load_pattern("/no/such/file.csv"), InputError);
}

TEST_CASE("a byte order mark, as of Excel's \"CSV UTF-8\", is passed over") {
  const PatternFile plain(header + "0,0,1,0,0,0\n180,0,2,0,0,0\n");
  const std::vector<double> samples = load_pattern(plain.path).samples;
  const PatternFile marked("\xEF\xBB\xBF" + header + "0,0,1,0,0,0\n180,0,2,0,0,0\n");
  CHECK(load_pattern(marked.path).samples == samples);
}

TEST_CASE("a pattern that is named with backslashes gets a hint") {
  RadioEnd end;
  end.antenna = "patterns\\horn.csv";
  CHECK_THROWS_WITH_AS(make_antenna(end), doctest::Contains("write / instead of \\ between the names of folders"),
                       ConfigError);
}
