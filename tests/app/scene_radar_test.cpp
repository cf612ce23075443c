// SPDX-License-Identifier: Apache-2.0
// `wavetracer scene radar`: its tables of a plate, whose cross section is known, and what it refuses.
#include <doctest/doctest.h>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>
#include "app/program.hpp"
#include "contains.hpp"

using namespace wavetracer::test;

namespace {

// A plate of 1 m x 1 m in the plane x = 0.
constexpr const char* plate = "v 0 -0.5 -0.5\nv 0 0.5 -0.5\nv 0 0.5 0.5\nv 0 -0.5 0.5\nf 1 2 3\nf 1 3 4\n";

std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);  // names
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

}  // namespace

TEST_CASE("scene radar: cross sections of a plate over azimuths, and echoes between two places") {
  const Folder folder;
  const std::string file = folder.file("plate.obj", plate);
  const Outcome sections =
      run_program({"scene", "radar", file, "--up", "z", "--frequency", "29979245800", "--azimuths", "0,2,0.5"});
  CHECK(sections.err.empty());
  const auto rows = rows_of(sections.out);
  REQUIRE(rows.size() == 5);
  const double k = 2 * M_PI / 0.01;
  for (const auto& row : rows) {
    const double azimuth = row[0] * M_PI / 180, x = k * std::sin(azimuth);
    const double field = std::cos(azimuth) * (x == 0 ? 1 : std::sin(x) / x) / 0.01;
    CHECK(std::abs(row[1] - 10 * std::log10(4 * M_PI * field * field)) < 0.05);
    CHECK(std::abs(row[4] - row[1]) < 0.05);
  }
  // From far away, echoes are those of the radar equation: lambda / (4 pi) sqrt(4 pi sigma) / (4 pi d^2).
  const Outcome echoes = run_program({"scene", "radar", file, "--up", "z", "--frequency", "29979245800",
                                      "--transmitter", "100000,0,0", "--receiver", "100000,0,0"});
  const auto parts = rows_of(echoes.out);
  REQUIRE(parts.size() == 2);
  const double amplitude = std::hypot(parts[0][2] + parts[1][2], parts[0][3] + parts[1][3]);
  CHECK(amplitude == doctest::Approx(0.01 / (4 * M_PI) * (1 / 0.01) / 1e10).epsilon(0.01));
  CHECK(parts[0][1] == doctest::Approx(2e5 / 299792458.0));
}

TEST_CASE("scene radar refuses what has no meaning") {
  const Folder folder;
  const std::string file = folder.file("plate.obj", plate);
  const auto said = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"scene", "radar", file});
    const Outcome outcome = run_program(more);
    CHECK(outcome.code == 2);
    return outcome.err;
  };
  CHECK(contains(said({"--transmitter", "1,0,0"}), "belong together"));
  CHECK(contains(said({"--azimuths", "0,10,0"}), "a step above 0"));
  CHECK(contains(said({"--bounces", "0"}), "--bounces"));
  CHECK(contains(said({"--transmitter", "0,0,0", "--receiver", "1,0,0"}), "is on facet"));
}
