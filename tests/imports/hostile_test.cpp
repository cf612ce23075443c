// Damaged files of every kind end in an InputError or in a scene, never in anything else.
#include <doctest/doctest.h>

#include <random>

#include "imported.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// True where an import was refused or went well.
bool survives(const std::string& text, const TemporaryFolder& folder) {
  ImportOptions options;
  options.output = folder.path() / "out";
  try {
    import_city(text, "map", options);
  } catch (const InputError&) {
  }
  return true;
}

}  // namespace

TEST_CASE("texts with bytes changed, cut short, or nested deeply") {
  OsmText map;
  const int outer = map.way(rectangle(0, 0, 50, 40), {{"height", "12"}});
  const int inner = map.way(rectangle(10, 10, 40, 30), {});
  map.relation({{outer, "outer"}, {inner, "inner"}}, {{"building", "yes"}});
  map.way(rectangle(60, 0, 70, 10), {{"building", "yes"}, {"height", "12 m"}});
  const std::string sumo =
      "<additional><location netOffset=\"0,0\" projParameter=\"!\"/><poly id=\"a\" type=\"building\" shape=\"0,0 9,0 "
      "9,9 "
      "0,9\"><param key=\"height\" value=\"9\"/></poly></additional>";
  const TemporaryFolder folder;
  std::mt19937 random(3);
  for (const std::string& good : {map.text(), sumo}) {
    for (int round = 0; round < 150; ++round) {
      std::string text = good;
      for (int k = 0; k <= round % 4; ++k) text[random() % text.size()] = static_cast<char>(random() % 256);
      if (round % 3 == 0) text.resize(random() % text.size());
      CHECK(survives(text, folder));
    }
  }
  std::string deep = "<additional>";
  for (int i = 0; i < 200000; ++i) deep += "<poly type=\"building\">";
  CHECK(survives(deep, folder));
  CHECK(survives("", folder));
  CHECK(survives("<!DOCTYPE osm [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]><osm>&b;</osm>", folder));
  CHECK(survives(std::string("\x00\x00\x00\x0d\x0a\x09OSMHeader\x18\x7f", 18), folder));
}

TEST_CASE("nodes outside of the earth, members that are themselves, huge numbers") {
  const TemporaryFolder folder;
  const std::string node =
      "<node id=\"1\" lat=\"95\" lon=\"500\"/><node id=\"2\" lat=\"1e9\" lon=\"1\"/>"
      "<node id=\"-9223372036854775807\" lat=\"1\" lon=\"1\"/>";
  CHECK(survives("<osm>" + node +
                     "<way id=\"1\"><nd ref=\"1\"/><nd ref=\"2\"/><nd ref=\"-9223372036854775807\"/>"
                     "<nd ref=\"1\"/><tag k=\"building\" v=\"yes\"/></way></osm>",
                 folder));
  CHECK(
      survives("<osm><relation id=\"1\"><member type=\"relation\" ref=\"1\" role=\"outer\"/><member type=\"way\" "
               "ref=\"1\" role=\"\"/><tag k=\"type\" v=\"multipolygon\"/><tag k=\"building\" v=\"yes\"/></relation>"
               "<way id=\"1\"/></osm>",
               folder));
  CHECK(survives("<osm><way id=\"1\"><tag k=\"building\" v=\"yes\"/></way></osm>", folder));
  CHECK(survives("<additional><poly type=\"building\" id=\"\" shape=\"1e308,1e308 -1e308,0 0,-1e308\"/></additional>",
                 folder));
}
