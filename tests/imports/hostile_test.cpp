// SPDX-License-Identifier: Apache-2.0
// Damaged files of every kind end in an InputError or in a scene, and in nothing else.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "imported.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Returns true if an import was refused or succeeded.
bool survives(const std::string& text, const TemporaryFolder& folder) {
  ImportOptions options;
  options.output = folder.path() / "out";
  try {
    import_city(text, "map", options);
  } catch (const InputError&) {
  }
  return true;
}

// Returns the summary of an import that may also refuse the map, within seconds of processor time.
ImportSummary summary_of(const std::string& text) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.output = folder.path() / "out";
  const std::clock_t start = std::clock();
  const ImportSummary summary = import_city(text, "map", options);
  CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 20);  // without limits this took minutes to days
  return summary;
}

std::string square_polygon(double x, double y, double side, const std::string& type = "building") {
  return fmt::format("<poly id=\"p\" type=\"{}\" shape=\"{},{} {},{} {},{} {},{}\"/>", type, x, y, x + side, y,
                     x + side, y + side, x, y + side);
}
std::string polygons(const std::string& text) {
  return "<additional><location netOffset=\"0,0\" projParameter=\"!\"/>" + text + "</additional>";
}

const std::string too_many = "inside of more than 200 others";

}  // namespace

TEST_CASE("rings and multipolygons of too many nodes are left out before they are assembled") {
  OsmText map;
  map.way(rectangle(100, 0, 150, 40), {{"building", "yes"}});
  Points comb;  // all edges are beside all others
  for (int i = 0; i < 40000; ++i) comb.emplace_back(i % 4 == 0 || i % 4 == 3 ? 0 : 90, i / 2 * 0.03);
  map.way(comb, {{"building", "yes"}});
  const int part = map.way(comb, {});
  map.relation({{part, "outer"}}, {{"building", "yes"}});
  CHECK(summary_of(map.text()).left_out.at("more than 5000 corners") == 2);
}

TEST_CASE("ways that many multipolygons name are not assembled again and again") {
  OsmText map;
  map.way(rectangle(100, 0, 150, 40), {{"building", "yes"}});
  Points comb;
  for (int i = 0; i < 4990; ++i) comb.emplace_back(i % 4 == 0 || i % 4 == 3 ? 0 : 90, i / 2 * 0.03);
  const int way = map.way(comb, {});
  for (int i = 0; i < 2000; ++i) map.relation({{way, "outer"}}, {{"building", "yes"}});
  CHECK(summary_of(map.text()).left_out.at("multipolygon with ways that belong to too many others") > 1980);
}

TEST_CASE("towers of polygons, and parts within them, take no square of their number") {
  std::string nested, parts;
  for (int i = 0; i < 10000; ++i) {
    nested += square_polygon(i * 0.01, i * 0.01, 3000 - 0.02 * i);
    parts += square_polygon(1400 + i % 100 * 2, 1400 + i / 100 * 2, 1, "building:part");
  }
  const ImportSummary summary = summary_of(polygons(nested + parts));
  CHECK(summary.left_out.at(too_many) > 7500);
  CHECK(summary.buildings + summary.parts > 0);
}

TEST_CASE("a building of many courtyards, and one inside of another that touches") {
  std::string courtyards = square_polygon(0, 0, 4000);
  for (int i = 0; i < 1200; ++i) courtyards += square_polygon(10 + i % 35 * 100, 10 + i / 35 * 100, 50);
  const ImportSummary summary = summary_of(polygons(courtyards));
  CHECK(summary.buildings == 1);
  CHECK(summary.courtyards == 1200);
  // The second one has an edge in common with the first: it is no courtyard but a building.
  const ImportSummary touching = summary_of(polygons(square_polygon(0, 0, 100) + square_polygon(10, 10, 10) +
                                                     square_polygon(20, 10, 10) + square_polygon(0, 50, 10)));
  CHECK(touching.courtyards == 1);
  CHECK(touching.buildings == 3);
}

TEST_CASE("a report names few types of polygons, in letters that a terminal can show") {
  std::string text = square_polygon(0, 0, 9);
  for (int i = 0; i < 200; ++i) text += square_polygon(0, 0, 9, fmt::format("a{}&#27;[31m&#10;", i));
  const auto left_out = summary_of(polygons(text)).left_out;
  CHECK(left_out.size() < 60);
  CHECK(left_out.at("polygon of another type") > 100);
  for (const auto& [reason, count] : left_out)
    CHECK(std::ranges::none_of(reason, [](char c) { return static_cast<unsigned char>(c) < ' '; }));
}

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

TEST_CASE("of two trees with one id and one version, the later one says where it stands") {
  const TemporaryFolder folder;
  ImportOptions options;
  options.vegetation = true;
  std::string trees;
  for (const char* place : {"", "lat=\"48.137\" lon=\"11.575\""})
    trees += std::string("<node id=\"9\" version=\"1\" ") + place + "><tag k=\"natural\" v=\"tree\"/></node>";
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  std::string whole = map.text();
  whole.insert(whole.rfind("</osm>"), trees);
  CHECK_NOTHROW(import_text(whole, folder, options));
}
