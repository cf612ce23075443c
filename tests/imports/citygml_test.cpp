// SPDX-License-Identifier: Apache-2.0
// CityGML: every way to write a ring and to link surfaces gives the same cube.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "city_texts.hpp"
#include "imported.hpp"
#include "imports/city_model.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::string with_blanks(std::string text, char blank) {
  std::ranges::replace(text, ' ', blank);
  return text;
}

// "0 0 0 1 0 0" as one text for each point.
std::vector<std::string> points_of(const std::string& ring) {
  std::vector<std::string> out;
  size_t blanks = 0;
  for (const char c : ring) {
    if (out.empty() || (c == ' ' && ++blanks % 3 == 0)) out.emplace_back();
    if (c != ' ' || !out.back().empty()) out.back() += c;
  }
  return out;
}

std::string lod2(const std::string& solid) { return "<bldg:lod2Solid>" + solid + "</bldg:lod2Solid>"; }

double cube_volume(const std::string& text) {
  const TemporaryFolder folder;
  const Imported result = import_text(text, folder, without_ground());
  CHECK(result.scene.report.free_edges == 0);
  CHECK(result.scene.triangles.size() == 12);
  return volume_m3(result.scene, "building_1") - 10 * 10 * 1;  // the foundation
}

// Surfaces that say what they are, with polygons p0 to p5.
std::string thematic_cube() {
  std::string out;
  for (size_t i = 0; i < 6; ++i) {
    const std::string kind = i == 0 ? "GroundSurface" : i == 1 ? "RoofSurface" : "WallSurface";
    out += fmt::format(
        "<bldg:boundedBy><bldg:{0}><bldg:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>"
        "<gml:Polygon gml:id=\"p{1}\"><gml:exterior>{2}</gml:exterior></gml:Polygon></gml:surfaceMember>"
        "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:{0}></bldg:boundedBy>",
        kind, i, pos_list(cube_rings()[i]));
  }
  return out;
}

}  // namespace

TEST_CASE("CityGML: solids and surfaces of every kind are the same cube") {
  CHECK(imports::is_citygml("<?xml version=\"1.0\"?>\n<!-- > --><core:CityModel xmlns:core=\"\">"));
  CHECK_FALSE(imports::is_citygml("<osm>"));
  for (const std::string& content :
       {"<bldg:lod1Solid>" + solid_gml(cube_surface()) + "</bldg:lod1Solid>", lod2(solid_gml(cube_surface("Shell"))),
        "<bldg:lod2MultiSurface>" + cube_surface("MultiSurface") + "</bldg:lod2MultiSurface>",
        lod2("<gml:CompositeSolid><gml:solidMember>" + solid_gml(cube_surface()) +
             "</gml:solidMember></gml:CompositeSolid>")})
    CHECK(cube_volume(gml(gml_building(content))) == doctest::Approx(1000));
}

TEST_CASE("CityGML: a part that is there in less detail than its building is left out, in more detail it replaces it") {
  const TemporaryFolder folder;
  const auto town = [&](int of_building, int of_part) {
    const auto body = [](int lod) {
      return fmt::format("<bldg:lod{0}Solid>{1}</bldg:lod{0}Solid>", lod, solid_gml(cube_surface()));
    };
    return import_text(gml(gml_building(body(of_building) + "<bldg:consistsOfBuildingPart><bldg:BuildingPart>" +
                                        body(of_part) + "</bldg:BuildingPart></bldg:consistsOfBuildingPart>")),
                       folder, without_ground())
        .summary;
  };
  CHECK(town(2, 1).buildings == 1);
  CHECK(town(2, 1).parts == 0);
  CHECK(town(2, 1).left_out.at("part of a building that is built in more detail instead") == 1);
  CHECK(town(1, 2).buildings == 0);
  CHECK(town(1, 2).left_out.at("building whose parts are built in more detail instead") == 1);
  CHECK(town(2, 2).parts == 1);
  CHECK(town(2, 2).left_out.empty());
}

TEST_CASE("CityGML: rings of every kind are the same cube") {
  for (int kind = 0; kind < 6; ++kind) {
    CAPTURE(kind);
    std::string members;
    for (const std::string& ring : cube_rings()) {
      std::string text;
      for (const std::string& point : points_of(ring)) {
        if (kind == 0) text += "<gml:pos>" + point + "</gml:pos>";
        if (kind == 1)
          text += "<gml:pointProperty><gml:Point><gml:pos>" + point + "</gml:pos></gml:Point></gml:pointProperty>";
        if (kind == 2) text += with_blanks(point, ',') + "\n";
        if (kind == 3) text += point + "<!-- a comment --> ";
      }
      if (kind == 2) text = "<gml:coordinates>" + text + "</gml:coordinates>";
      if (kind == 3) text = "<gml:posList>" + text + "</gml:posList>";
      if (kind > 3)
        text = "<gml:posList srsDimension=\"3\"> " + with_blanks(ring, kind == 4 ? '\n' : '\t') + "</gml:posList>";
      members += member("<gml:LinearRing>" + text + "</gml:LinearRing>");
    }
    CHECK(cube_volume(gml(gml_building(lod2(solid_gml("<gml:Shell>" + members + "</gml:Shell>"))))) ==
          doctest::Approx(1000));
  }
}

TEST_CASE("CityGML: a solid that links to surfaces, in circles and the wrong way round, has each of them once") {
  const TemporaryFolder folder;
  std::string links;
  for (size_t i = 0; i < 6; ++i) links += fmt::format("<gml:surfaceMember xlink:href=\"#p{}\"/>", i);
  const std::string own = lod2(solid_gml("<gml:CompositeSurface gml:id=\"all\">" + links +
                                         "<gml:surfaceMember xlink:href=\"#all\"/></gml:CompositeSurface>"));
  CHECK(cube_volume(gml(gml_building(own + thematic_cube()))) == doctest::Approx(1000));
  ImportOptions options = without_ground();
  options.roof_material = "brick";
  const Imported painted = import_text(gml(gml_building(own + thematic_cube())), folder, options);
  CHECK(volume_m3(painted.scene, "building_1") == doctest::Approx(1100));
  CHECK(material(painted.scene, "building_1 b roof") == "brick");
  CHECK(roof_area_m2(painted.scene, "building_1 b roof") == doctest::Approx(100));
  // A roof that is stored upside down, and turned by its OrientableSurface.
  std::string members;
  for (size_t i = 0; i < 6; ++i)
    members += i != 1
                   ? member(pos_list(cube_rings()[i]))
                   : "<gml:surfaceMember><gml:OrientableSurface orientation=\"-\"><gml:baseSurface><gml:Polygon>"
                     "<gml:exterior>" +
                         pos_list("0 0 10 0 10 10 10 10 10 10 0 10 0 0 10") +
                         "</gml:exterior></gml:Polygon></gml:baseSurface></gml:OrientableSurface></gml:surfaceMember>";
  CHECK(cube_volume(gml(gml_building(lod2(solid_gml("<gml:Shell>" + members + "</gml:Shell>"))))) ==
        doctest::Approx(1000));
  // The polygons of a part belong to it, although the building's own solid links to them.
  const std::string part = "<bldg:consistsOfBuildingPart><bldg:BuildingPart>" + thematic_cube() +
                           "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  const Imported parts = import_text(gml(gml_building(own + part)), folder, options);
  CHECK(parts.summary.buildings == 0);
  CHECK(parts.summary.parts == 1);
  CHECK(roof_area_m2(parts.scene, "building_1 BuildingPart 2 roof") == doctest::Approx(100));
}

TEST_CASE("CityGML: windows of LOD3 are glass, rooms and LOD4 are left out, bridges are built, plants are not") {
  const TemporaryFolder folder;
  ImportOptions fine = without_ground();
  fine.lod = "3";
  const auto surface = [](const std::string& members) {
    return "<bldg:lod3MultiSurface><gml:MultiSurface>" + members + "</gml:MultiSurface></bldg:lod3MultiSurface>";
  };
  const std::string hole = "<gml:interior>" + pos_list("2 0 2 2 0 4 4 0 4 4 0 2 2 0 2") + "</gml:interior>";
  const std::string wall = surface(member(pos_list(cube_rings()[2]), hole)),
                    window = surface(member(pos_list("2 0 2 4 0 2 4 0 4 2 0 4 2 0 2")));
  const Imported glazed =
      import_text(gml(gml_building(
                      "<bldg:boundedBy><bldg:WallSurface>" + wall + "<bldg:opening><bldg:Window>" + window +
                      "</bldg:Window></bldg:opening></bldg:WallSurface></bldg:boundedBy><bldg:interiorRoom><bldg:Room/>"
                      "</bldg:interiorRoom><bldg:lod4Solid>" +
                      solid_gml(cube_surface()) + "</bldg:lod4Solid>")),
                  folder, fine);
  CHECK(material(glazed.scene, "building_1 b glass") == "glass");
  CHECK(glazed.summary.left_out.at("room or fitting inside of a building") == 1);
  CHECK(glazed.scene.triangles.size() == 10);
  const std::string bridge =
      "<brid:Bridge><brid:lod2Solid>" + solid_gml(cube_surface()) + "</brid:lod2Solid></brid:Bridge>";
  const Imported others = import_text(gml("<core:cityObjectMember>" + bridge +
                                          "</core:cityObjectMember><core:cityObjectMember><veg:PlantCover/>"
                                          "</core:cityObjectMember>"),
                                      folder);
  CHECK(others.summary.buildings == 1);
  CHECK(others.summary.left_out.at("object of the type 'PlantCover'") == 1);
}
