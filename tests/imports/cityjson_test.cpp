// SPDX-License-Identifier: Apache-2.0
// CityJSON against closed forms: a house with a gable roof, parts and levels of detail, roles and materials.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "city_texts.hpp"
#include "imported.hpp"
#include "imports/city_model.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The area of all triangles of an object that look up and are not level.
double slopes_m2(const Scene& scene, const std::string& object) {
  double sum = 0;
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    if (!scene.objects[scene.triangle_object[i]].starts_with(object)) continue;
    const auto& t = scene.triangles[i];
    const glm::dvec3 area =
        glm::cross(scene.vertices[t[1]] - scene.vertices[t[0]], scene.vertices[t[2]] - scene.vertices[t[0]]) / 2.0;
    if (area.z > 0 && glm::length(area) > area.z * 1.0001) sum += glm::length(area);
  }
  return sum;
}

}  // namespace

TEST_CASE("a CityJSON house with a gable roof is closed, and has the volume, roof and materials that it must have") {
  const TemporaryFolder folder;
  ImportOptions options;
  options.roof_material = "brick";
  options.wall_material = "wood";
  const std::string text = city_json(gable_house());
  CHECK(imports::is_cityjson(text.substr(0, 200)));
  const Imported plain = import_text(text, folder), painted = import_text(text, folder, options);
  for (const Imported* one : {&plain, &painted}) {
    CHECK(one->summary.buildings == 1);
    CHECK(volume_m3(one->scene, "building_1") == doctest::Approx(gable_volume + gable_floor * 1));
    CHECK(slopes_m2(one->scene, "building_1") == doctest::Approx(gable_roof).epsilon(1e-4));
    CHECK(top_m(one->scene, "building_1") == doctest::Approx(10));
    CHECK(bottom_m(one->scene, "building_1") == doctest::Approx(-1));
    CHECK(one->summary.heights.find("100.0") != std::string::npos);
    CHECK(one->summary.left_out.empty());
    CHECK(one->summary.warnings.size() == 1);  // no coordinate system
  }
  CHECK(plain.scene.report.free_edges == 4);  // the edges of the ground
  CHECK(plain.scene.surfaces.size() == 8);
  CHECK(material(painted.scene, "building_1 house roof") == "brick");
  CHECK(material(painted.scene, "building_1 house") != "");
  CHECK(has_object(painted.scene, "building_1 house roof"));
  // Without semantics slopes tell the roles; without a solid, too, and whichever way its surfaces look.
  const std::string turned =
      "[[[[1,2,3,0]],[[4,5,1,0]],[[6,7,3,2]],[[7,8,4,0,3]],[[5,9,6,2,1]],[[8,9,5,4]],[[9,8,7,6]]]]";
  const Imported bare = import_text(city_json(building("house", solid("2", gable_solid))), folder, options),
                 inward = import_text(city_json(building("house", solid("2", turned))), folder, options);
  CHECK(inward.summary.guessed.at("object whose surfaces look inward: turned") == 1);
  for (const Imported* one : {&bare, &inward}) {
    CHECK(volume_m3(one->scene, "building_1") == doctest::Approx(gable_volume + gable_floor));
    CHECK(slopes_m2(one->scene, "building_1 house roof") == doctest::Approx(gable_roof).epsilon(1e-4));
  }
}

TEST_CASE("the highest level of detail that is asked for is built, and parts instead of the block around them") {
  const TemporaryFolder folder;
  const std::string box = "[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]";
  const std::string house =
      building("house", solid("1.2", box) + "," + solid("2.2", gable_solid) + "," + solid("3.0", box));
  const auto volume = [&](const std::string& lod) {
    ImportOptions options = without_ground();
    options.lod = lod;
    const Imported result = import_text(city_json(house), folder, options);
    CHECK(result.summary.buildings == 1);
    return volume_m3(result.scene, "building_1") - gable_floor;
  };
  CHECK(volume("") == doctest::Approx(gable_volume));
  CHECK(volume("2") == doctest::Approx(gable_volume));
  CHECK(volume("1") == doctest::Approx(96 * 6));
  CHECK(volume("1.3") == doctest::Approx(96 * 6));
  CHECK(volume("3") == doctest::Approx(96 * 6));
  CHECK_THROWS_WITH_AS(volume("1.1"), doctest::Contains("more detail than --lod asks for"), InputError);
  CHECK_THROWS_WITH_AS(volume("0"), doctest::Contains("--lod 0"), ConfigError);
  CHECK_THROWS_WITH_AS(volume("2,2"), doctest::Contains("level of detail"), ConfigError);

  const Imported parts = import_text(
      city_json(building("z block", solid("1", box), "Building", R"("children":["a part"],)") + "," +
                building("a part", solid("2", gable_solid), "BuildingPart", R"("parents":["z block"],)") + "," +
                building("chimney", solid("2", box), "BuildingInstallation", R"("parents":["a part"],)") + "," +
                building("room", solid("2", box), "BuildingRoom", R"("parents":["z block"],)") + "," +
                building("odd", solid("2", box), "+Odd")),
      folder, without_ground());
  CHECK(parts.summary.buildings == 0);
  CHECK(parts.summary.parts == 2);
  CHECK(parts.summary.left_out.at("building whose parts are built in more detail instead") == 1);
  CHECK(parts.summary.left_out.at("object of the type 'BuildingRoom'") == 1);
  CHECK(parts.summary.left_out.at("object of the type '+Odd'") == 1);
}

TEST_CASE("a building and its parts have one level of detail; parts beside each other may differ") {
  const TemporaryFolder folder;
  const std::string box = "[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]";
  // A block and two parts, each with geometry of these levels; the gable is the finest.
  const auto town = [&](const std::vector<std::string>& levels) {
    std::string objects;
    const std::array<std::string, 3> names = {"block", "a", "b"};
    for (size_t i = 0; i < 3; ++i) {
      std::string geometries;
      for (size_t begin = 0; begin < levels[i].size(); begin += 4)
        geometries += (begin > 0 ? "," : "") +
                      solid(levels[i].substr(begin, 3), levels[i].substr(begin, 3) == "2.2" ? gable_solid : box);
      objects += (i > 0 ? "," : "") + building(names[i], geometries, i == 0 ? "Building" : "BuildingPart",
                                               i == 0 ? R"("children":["a","b"],)" : R"("parents":["block"],)");
    }
    return import_text(city_json(objects), folder, without_ground());
  };
  constexpr uint64_t gable = 16, block = 12;  // triangles
  const auto less = "part of a building that is built in more detail instead";
  const auto more = "building whose parts are built in more detail instead";
  const Imported finer = town({"2.2", "1.2", "1.2"});
  CHECK(finer.summary.buildings == 1);
  CHECK(finer.summary.parts == 0);
  CHECK(finer.summary.left_out.at(less) == 2);
  CHECK(finer.summary.triangles == gable);
  const Imported coarser = town({"1.2", "2.2", "2.2"});
  CHECK(coarser.summary.left_out.at(more) == 1);
  CHECK(coarser.summary.triangles == 2 * gable);
  const Imported mixed = town({"1.2", "2.2", "1.2"});
  CHECK(mixed.summary.left_out == std::map<std::string, uint64_t>{{more, 1}});
  CHECK(mixed.summary.triangles == gable + block);
  const Imported alike = town({"1.2 2.2", "1.2 2.2", "1.2"});
  CHECK(alike.summary.left_out == std::map<std::string, uint64_t>{{less, 1}});
  CHECK(alike.summary.triangles == 2 * gable);
  CHECK(town({"1.2", "1.2", "1.2"}).summary.left_out.empty());
}

TEST_CASE("all kinds of geometry of CityJSON") {
  const TemporaryFolder folder;
  const std::string box = "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]";
  for (const std::string kind : {"MultiSurface", "CompositeSurface", "Solid", "MultiSolid", "CompositeSolid"}) {
    CAPTURE(kind);
    const std::string inner = kind == "Solid"           ? "[" + box + "," + box + "]"
                              : kind.ends_with("Solid") ? "[[" + box + "]]"
                                                        : box;
    const Imported result =
        import_text(city_json(building("b", fmt::format(R"({{"type":"{}","lod":1,"boundaries":{}}})", kind, inner))),
                    folder, without_ground());
    CHECK(volume_m3(result.scene, "building_1") == doctest::Approx(96 * 7));
    CHECK(result.summary.left_out.size() == (kind == "Solid"));
  }
  // Virtual and inner surfaces, windows, and what points to nothing.
  const std::string roles =
      R"("semantics":{"surfaces":[{"type":"ClosureSurface"},{"type":"Window"},{"type":"CeilingSurface"},{"type":"Door"}],)"
      R"("values":[[0,null,1,2,3,null]]})";
  const Imported result = import_text(city_json(building("b", solid("3", "[" + box + "]", roles))), folder, [] {
    ImportOptions options = without_ground();
    options.lod = "3";
    return options;
  }());
  CHECK(result.summary.left_out.at("ClosureSurface, where nothing is") == 1);
  CHECK(result.summary.left_out.at("surface inside of a building") == 1);
  CHECK(material(result.scene, "building_1 b glass") == "glass");
  CHECK(material(result.scene, "building_1 b wood") == "wood");
  CHECK(result.scene.triangles.size() == 8);
}

TEST_CASE("each building comes down to flat ground with its parts, and bays stay where they are") {
  const TemporaryFolder folder;
  // A house of 10 m a side at 3 m, with a ground surface at 3 m, and one at 6 m below a bay.
  const std::string vertices =
      "[[0,0,300],[1000,0,300],[1000,1000,300],[0,1000,300],[0,0,1300],[1000,0,1300],[1000,1000,1300],[0,1000,1300],"
      "[1000,0,700],[1000,1000,700],[1200,0,700],[1200,1000,700],[1200,0,1300],[1200,1000,1300]]";
  const std::string boundaries =
      "[[[0,3,2,1]],[[8,9,11,10]],[[4,5,12,13,6,7]],[[0,1,8,10,12,5,4]],[[2,3,7,6,13,11,9]],[[1,2,9,8]],[[10,11,13,12]]"
      ","
      "[[3,0,4,7]]]";
  const std::string roles =
      R"("semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"},{"type":"WallSurface"}],)"
      R"("values":[0,0,1,2,2,2,2,2]})";
  const Imported result = import_text(
      city_json(
          building("b", fmt::format(R"({{"type":"MultiSurface","lod":"2","boundaries":{},{}}})", boundaries, roles)),
          vertices),
      folder, without_ground());
  CHECK(volume_m3(result.scene, "building_1") == doctest::Approx(10 * 10 * 10 + 2 * 10 * 6 + 100));
  CHECK(bottom_m(result.scene, "building_1") == doctest::Approx(-1));
  CHECK(top_m(result.scene, "building_1") == doctest::Approx(10));
  CHECK(result.scene.report.free_edges == 0);
}
