// SPDX-License-Identifier: Apache-2.0
// Road networks: the one that comes with the program, and small ones with every fault.
#include "imports/road_network.hpp"
#include "folders.hpp"

#include <doctest/doctest.h>
#include <zlib.h>

#include "base/file.hpp"

#include "imported.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const std::string town = test::source_folder() + "/configs/sumo/town.net.xml";

std::string net(const std::string& lane) {
  return "<net version=\"1.16\">\n<edge id=\"e\">\n" + lane + "\n</edge>\n</net>\n";
}

std::string error_of(const std::string& content) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.net.xml", content);
  try {
    read_road_network(file);
  } catch (const InputError& error) {
    const std::string text = error.what();
    return text.substr(text.find("a.net.xml"));
  }
  return "no error";
}

}  // namespace

TEST_CASE("lanes with their widths and heights, junctions included, areas of pedestrians not") {
  const TemporaryFolder folder;
  const auto file = folder.write("a.net.xml", R"(<net>
<edge id="a"><lane id="a_0" shape="0,1 2.5,3"/><lane id="a_1" width="2" shape="0,1,4 5,6,7 8,9,10"/></edge>
<edge id=":c" function="internal"><lane id=":c_0" shape="1,1 2,2"/></edge>
<edge id=":w" function="walkingarea"><lane id=":w_0" shape="1,1 2,2 3,3"/></edge>
<edge id=":x" function="crossing"><lane id=":x_0" shape="1,1 2,2"/></edge>
</net>)");
  const std::vector<Street> streets = read_road_network(file);
  REQUIRE(streets.size() == 3);
  CHECK(streets[0].width_m == 3.2);
  CHECK(streets[0].centre_m == std::vector<glm::dvec3>{{0, 1, 0}, {2.5, 3, 0}});
  CHECK(streets[1].width_m == 2);
  CHECK(streets[1].centre_m == std::vector<glm::dvec3>{{0, 1, 4}, {5, 6, 7}, {8, 9, 10}});
}

TEST_CASE("the town's network, plain and compressed") {
  const std::vector<Street> plain = read_road_network(town);
  CHECK(plain.size() > 50);
  const TemporaryFolder folder;
  const std::string file = folder / "town.net.xml.gz";
  const gzFile out = gzopen(file.c_str(), "wb");
  const std::string text = read_file(town);
  CHECK(gzwrite(out, text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size()));
  gzclose(out);
  const std::vector<Street> compressed = read_road_network(file);
  REQUIRE(compressed.size() == plain.size());
  for (size_t i = 0; i < plain.size(); ++i) CHECK(compressed[i].centre_m == plain[i].centre_m);
}

TEST_CASE("streets move with the trajectories; a generated city knows its own; without either there are none") {
  Config config;
  CHECK(known_streets(config).empty());
  config.scene.generate = "--blocks 2x4";
  CHECK(known_streets(config).size() == 8);
  config.scene.generate.clear();
  config.scene.streets = town;
  const std::vector<Street> still = known_streets(config);
  config.trajectories.offset_m = {100, -20, 3};
  config.trajectories.scale = 2;
  const std::vector<Street> moved = known_streets(config);
  REQUIRE(moved.size() == still.size());
  CHECK(moved[7].centre_m[1] == 2.0 * still[7].centre_m[1] + glm::dvec3(100, -20, 3));
  CHECK(moved[7].width_m == 2 * still[7].width_m);
}

TEST_CASE("what is no network is an error with its line") {
  CHECK(error_of("<routes/>") ==
        "a.net.xml: the root element is <routes>, but that of a SUMO network is <net>: give the .net.xml that "
        "netconvert wrote");
  CHECK(error_of("") ==
        "a.net.xml: this is no XML text, but a SUMO network is one: give the .net.xml that netconvert wrote");
  CHECK(error_of("<net>\n<edge>\n</net>").starts_with("a.net.xml:3: not well-formed XML: "));
  CHECK(error_of("<net></net>") == "a.net.xml: the network has no lane");
  CHECK(error_of(net("<lane id=\"e_0\" shape=\"0,1 2;3\"/>")) ==
        "a.net.xml:3: <lane id=\"e_0\">: shape must be points \"x,y\" or \"x,y,z\" separated by blanks, not '2;3'");
  CHECK(error_of(net("<lane id=\"e_0\" shape=\"0,1 nan,3\"/>")).ends_with("not 'nan,3'"));
  CHECK(error_of(net("<lane id=\"e_0\" shape=\"0,1,2,3 1,1\"/>")).ends_with("not '0,1,2,3'"));
  CHECK(error_of(net("<lane id=\"e_0\" shape=\"0,1\"/>")) ==
        "a.net.xml:3: <lane id=\"e_0\">: shape has less than two points");
  CHECK(error_of(net("<lane id=\"e_0\" width=\"-1\" shape=\"0,1 2,3\"/>")) ==
        "a.net.xml:3: <lane id=\"e_0\">: width = '-1' is not a positive number");
  CHECK_THROWS_WITH_AS(read_road_network("/nowhere/a.net.xml"), doctest::Contains("no such file"), InputError);
}
