// SPDX-License-Identifier: Apache-2.0
// Files of maps: what GeoTIFF can name, the bytes of the writers that no other program reads, and refusals. GDAL and
// NumPy read the files in read_coverage.py.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "coverage/geotiff.hpp"
#include "coverage/made_grid.hpp"
#include "coverage/png.hpp"
#include "coverage/write_map.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::coverage;
using test::MadeGrid;
namespace fs = std::filesystem;

namespace {

// Three by two cells; cell 4 has no path.
Map written_map() {
  MadeGrid made(3, 2, {{0, 0, 20}, {9, 9, 20}});
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t cell = 0; cell < 4; ++cell)
      made.add(tx, cell, std::pow(10, -3.0 - 0.5 * (tx == 0 ? cell : 3 - cell)), 1e-7, cell % 2);
  const SavedRun run = made.written();
  ReceiverGridConfig grid;
  grid.name = "g";
  return coverage_map(run, {}, run.frame(0), test::links_of(run), grid, {});
}

std::string content(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

std::string refusal(const std::string& projection) {
  try {
    named_projection(projection);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("UTM has a code of EPSG, and a transverse Mercator projection has its numbers") {
  CHECK(named_projection("+proj=utm +zone=32 +ellps=WGS84 +datum=WGS84 +units=m +no_defs").epsg == 32632);
  CHECK(named_projection("+proj=utm +zone=21 +south +ellps=GRS80 +units=m +type=crs").epsg == 32721);
  const NamedProjection own =
      named_projection("+proj=tmerc +lat_0=48.1 +lon_0=-11.5 +k=0.9996 +x_0=500 +y_0=-7 +ellps=WGS84 +units=m");
  CHECK(own.epsg == 0);
  CHECK(own.latitude_deg == 48.1);
  CHECK(own.longitude_deg == -11.5);
  CHECK(own.scale == 0.9996);
  CHECK(own.false_east_m == 500);
  CHECK(own.false_north_m == -7);
}

TEST_CASE("a projection that GeoTIFF cannot name is refused with the reason") {
  for (const auto& [projection, reason] : {std::pair{"+proj=merc +ellps=WGS84", "+proj=merc is not known"},
                                           std::pair{"+proj=utm +zone=77 +ellps=WGS84", "it has no zone from 1 to 60"},
                                           std::pair{"+proj=tmerc +ellps=bessel", "it is not on WGS84"},
                                           std::pair{"+proj=tmerc +units=us-ft", "its coordinates are not metres"},
                                           std::pair{"+proj=tmerc +lat_0=x", "+lat_0 is no number"},
                                           std::pair{"+proj=tmerc +gamma=3", "+gamma is not known"},
                                           std::pair{"proj=tmerc", "\"proj=tmerc\" does not begin with +"}}) {
    CAPTURE(projection);
    CHECK(refusal(projection).find(reason) != std::string::npos);
  }
}

TEST_CASE("the corner of a map is half a cell beyond its first cells, without the offset of the georeference") {
  const Map map = written_map();
  const MapPlace own = place_of(map, {}),
                 moved = place_of(map, Georeference{"+proj=utm +zone=32", {-100, 1000}, "", {}});
  CHECK(own.west_m == doctest::Approx(0));
  CHECK(own.north_m == doctest::Approx(20));
  CHECK(moved.west_m == doctest::Approx(100));
  CHECK(moved.north_m == doctest::Approx(-980));
  CHECK(world_file(own) == "10\n0\n0\n-10\n5\n15\n");
}

TEST_CASE("colours span the values but for extreme ones") {
  std::vector<double> values = {NAN, INFINITY, -300, 20};
  for (int k = 0; k < 400; ++k) values.push_back(-97 + 0.1 * k);
  const ColourRange decibels = colour_range(layer_kind("path_gain_db"), values);
  CHECK(decibels.low == -100);
  CHECK(decibels.high == -55);
  const ColourRange counts = colour_range(layer_kind("paths"), std::vector<double>{NAN, 3, 7});
  CHECK(counts.low == 0);
  CHECK(counts.high == 7);
  CHECK(colour_range(layer_kind("paths"), std::vector<double>{NAN}).high == 1);
}

TEST_CASE("the table has a row for each cell, and files replace those of an earlier map") {
  const Map map = written_map();
  const std::string table = table_of(map, {});
  CHECK(table.starts_with(
      "ix,iy,x_m,y_m,z_m,path_gain_db,narrowband_gain_db,best_server,margin_db,delay_spread_ns,k_factor_db,line_of_sight,paths,cell_mean_db,fading_db,tx\n"
      "0,0,5,5,1.5,"));
  CHECK(table.find("\n1,1,15,15,1.5,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,\n") != std::string::npos);
  CHECK(table.find(",-inf,t1\n") != std::string::npos);
  CHECK(std::ranges::count(table, '\n') == 7);
  test::TemporaryFolder folder;
  std::ofstream(folder.path() / "paths.png") << "old";
  std::ofstream(folder.path() / "notes.txt") << "mine";
  const std::vector<fs::path> files = write_maps({{&map, 1}, false, {"csv", "npy", "geotiff", "png"}}, folder.path());
  CHECK(files.size() == 2 + 3 + 10 * 4);
  for (const fs::path& file : files) CHECK(fs::file_size(file) > 10);
  CHECK(content(folder.path() / "coverage.csv") == table);
  CHECK(content(folder.path() / "notes.txt") == "mine");
  CHECK(content(folder.path() / "paths.png").starts_with("\x89PNG"));
  const std::string array = content(folder.path() / "paths.npy");
  CHECK(array.size() == 128 + 6 * 8);
  CHECK(array.find("'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }") != std::string::npos);
}

TEST_CASE("a map whose projection GeoTIFF cannot name leaves the folder as it was") {
  test::TemporaryFolder folder;
  const Georeference mercator{"+proj=merc +ellps=WGS84", {0, 0}, "", {}};
  const Map map = written_map();
  CHECK_THROWS_AS(write_maps({{&map, 1}, false, {"csv", "geotiff"}, mercator}, folder.path()), InputError);
  CHECK(fs::is_empty(folder.path()));
  CHECK(write_maps({{&map, 1}, false, {"csv"}, mercator}, folder.path()).size() == 2);
  CHECK(content(folder.path() / "coverage.csv").starts_with("ix,iy,x_m,y_m,z_m,lon_deg,lat_deg,"));
}
