// SPDX-License-Identifier: Apache-2.0
// Objects that no longer exist: deleted in an editor, or in the last of several versions that a file contains.
#include <doctest/doctest.h>

#include <fstream>

#include "imported.hpp"
#include "imports/osm_text.hpp"
#include "imports/osm_versions.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr const char* gone = "deleted in the editor or in a later version (action='delete', visible='false')";

// Writes an attribute into the tag of an object.
std::string with(std::string text, const std::string& element, int id, const std::string& attribute) {
  const std::string tag = "<" + element + " id=\"" + std::to_string(id) + "\"";
  const size_t at = text.find(tag);
  REQUIRE(at != text.npos);
  return text.insert(at + tag.size(), " " + attribute);
}

std::string before_end(std::string text, const std::string& more) { return text.insert(text.rfind("</osm>"), more); }

}  // namespace

TEST_CASE("a house, a courtyard and a tree that an editor has deleted are not built, what it has changed is") {
  OsmText map;
  const int kept = map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}, {"height", "20"}});
  const int house = map.way(rectangle(20, 0, 30, 10), {{"building", "yes"}, {"height", "20"}});
  const int outer = map.way(rectangle(40, 0, 60, 20), {}), inner = map.way(rectangle(45, 5, 50, 10), {});
  const int block = map.relation({{outer, "outer"}, {inner, "inner"}}, {{"building", "yes"}});
  const int tree = map.tree(5, 30, {{"natural", "tree"}});
  const TemporaryFolder folder;
  ImportOptions options;
  const std::string all = map.text();
  CHECK(import_text(all, folder, options).summary.buildings == 3);
  for (const std::string word :
       {"action='delete'", "action=\"delete\"", "visible=\"false\"", "action='delete' visible='true'"}) {
    CAPTURE(word);
    const std::string text = with(with(with(all, "way", house, word), "relation", block, word), "node", tree, word);
    const auto [summary, scene] = import_text(text, folder, options);
    CHECK(summary.buildings == 1);
    CHECK(summary.trees == 0);
    CHECK(summary.left_out.at(gone) == 2);
    CHECK(has_object(scene, "way_" + std::to_string(kept)));
  }
  const auto [summary, scene] = import_text(
      with(with(all, "way", house, "action='modify'"), "relation", block, "action='create'"), folder, options);
  CHECK(summary.buildings == 3);
  CHECK(summary.left_out.empty());
  // A member that is gone is missing.
  const Imported open = import_text(with(all, "way", inner, "action='delete'"), folder, options);
  CHECK(open.summary.buildings == 2);
  CHECK(open.summary.left_out.at("multipolygon with a missing way, as if clipped at the border of an extract") == 1);
  options.vegetation = false;
  CHECK_THROWS_WITH_AS(
      import_text(with(with(with(all, "way", kept, "action='delete'"), "way", house, "action='delete'"), "relation",
                       block, "action='delete'"),
                  folder, options),
      doctest::Contains("deleted in the editor"), InputError);
}

TEST_CASE("words of deletion that delete nothing: those of users, tags and comments") {
  OsmText map;
  const int house = map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}, {"note", "action='delete'"}});
  const std::string text = with(map.text(), "way", house, "user=\"delete\"");
  const TemporaryFolder folder;
  CHECK(import_text(before_end(text, "<!-- <way id=\"" + std::to_string(house) + "\" action='delete'/> -->"), folder)
            .summary.buildings == 1);
  CHECK(imports::deleted_in_editor("<osm><node id='-7' action='delete'/><way id='x' action='delete'/>")
            .nodes.contains(-7));
  CHECK(imports::deleted_in_editor("action delete").nodes.empty());
}

TEST_CASE("of several versions of an object the last one counts, wherever it is in the file") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}, {"height", "5"}});
  const int house = map.way(rectangle(20, 0, 30, 10), {{"building", "yes"}, {"height", "20"}});
  const int shed = map.way(rectangle(40, 0, 50, 10), {{"building", "yes"}, {"height", "20"}});
  const int first = house - 4;  // its first node
  const std::string id = std::to_string(house), refs = [&] {
    std::string out;
    for (const int node : {first, first + 1, first + 2, first + 3, first})
      out += "<nd ref=\"" + std::to_string(node) + "\"/>";
    return out;
  }();
  const std::string higher = "<way id=\"" + id + "\" version=\"2\">" + refs +
                             "<tag k=\"building\" v=\"yes\"/><tag k=\"height\" v=\"30\"/></way>";
  const std::string no_house =
      "<way id=\"" + id + "\" version=\"3\">" + refs + "<tag k=\"demolished:building\" v=\"yes\"/></way>";
  const std::string deleted = "<way id=\"" + std::to_string(shed) + "\" version=\"2\" visible=\"false\"/>";
  const TemporaryFolder folder;
  const auto import_more = [&](const std::string& more) { return import_text(before_end(map.text(), more), folder); };
  CHECK(top_m(import_more(higher).scene, "way_" + id) == 30);
  CHECK(import_more(higher + no_house).summary.buildings == 2);
  CHECK(import_more(no_house + higher).summary.buildings == 2);
  CHECK(import_more(deleted).summary.buildings == 2);
  // A node that moves, and one that goes.
  std::string node = map.text();
  const size_t at = node.find("<node id=\"" + std::to_string(first) + "\"");
  node = node.substr(at, node.find("/>", at) + 2 - at);
  node.replace(node.find("version=\"1\""), 11, "version=\"2\"");
  std::string moved = node;
  const size_t lon = moved.find("lon=\"") + 5;
  moved.replace(lon, moved.find('"', lon) - lon, "11.5752");
  CHECK(import_more(moved).scene.vertices != import_more(node).scene.vertices);
  CHECK(import_more(node).scene.vertices == import_text(map.text(), folder).scene.vertices);
  CHECK(import_more("<node id=\"" + std::to_string(first) + "\" version=\"2\" visible=\"false\"/>")
            .summary.left_out.at("outline with a missing node, as if clipped at the border of an extract") == 1);
}

TEST_CASE("a change file: what it deletes is gone, what it holds no nodes of is told") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  const int house = map.way(rectangle(20, 0, 30, 10), {{"building", "yes"}});
  std::string text = map.text();
  const size_t begin = text.find("<osm version=\"0.6\">");
  const std::string objects = text.substr(begin + 19, text.rfind("</osm>") - begin - 19);
  const std::string change = "<osmChange version=\"0.6\"><create>" + objects + "</create><delete><way id=\"" +
                             std::to_string(house) + "\" version=\"2\"/></delete></osmChange>";
  const TemporaryFolder folder;
  CHECK(import_text(change, folder).summary.buildings == 1);
}

TEST_CASE("an outline whose id is too large for the assembler is left out and told") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  const std::string house = std::to_string(map.way(rectangle(20, 0, 30, 10), {{"building", "yes"}}));
  const TemporaryFolder folder;
  for (const std::string id : {"4611686036854775806", "-4611686036854775806"}) {
    std::string text = map.text();
    text.replace(text.find("<way id=\"" + house) + 9, house.size(), id);
    const ImportSummary summary = import_text(text, folder).summary;
    CHECK(summary.buildings == 1);
    CHECK(summary.left_out.at("outline whose id is too large") == 1);
  }
}

TEST_CASE("a tree without a place is counted, and the others are planted") {
  OsmText map;
  const int lost = map.tree(5, 30, {{"natural", "tree"}});
  map.tree(9, 30, {{"natural", "tree"}});
  std::string text = map.text();
  const size_t at = text.find("lat=", text.find("<node id=\"" + std::to_string(lost) + "\""));
  REQUIRE(at != text.npos);
  text.replace(at, 4, "lap=");
  const TemporaryFolder folder;
  ImportOptions options;
  const Imported imported = import_text(text, folder, options);
  CHECK(imported.summary.trees == 1);
  CHECK(imported.summary.left_out.at("tree without a place") == 1);
}
