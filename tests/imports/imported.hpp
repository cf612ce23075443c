// SPDX-License-Identifier: Apache-2.0
// Small maps written for the tests, imported into a temporary folder and loaded like any scene.
// Maps are in metres about MAP_ORIGIN; nodes of OSM are rounded to 1e-7 degrees, which is 11 mm.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "imports/imports.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::test {

using Points = std::vector<std::pair<double, double>>;
using TagList = std::vector<std::pair<std::string, std::string>>;

Points rectangle(double x0, double y0, double x1, double y1);

// An .osm text, put together object by object.
class OsmText {
 public:
  int way(const Points& points, const TagList& tags, bool closed = true);
  int tree(double x, double y, const TagList& tags);
  int relation(const std::vector<std::pair<int, std::string>>& ways, const TagList& tags);
  std::string text(bool nodes_last = false) const;

 private:
  std::string nodes_, ways_, relations_;
  int next_ = 1;
};

struct Imported {
  ImportSummary summary;
  Scene scene;
};
Imported import_text(const std::string& text, const TemporaryFolder& folder, ImportOptions options = {});

// Return, for all triangles whose object's name starts with `object`: the volume that they enclose (outward normals:
// positive), the area of those that look up, and the greatest and least height.
double volume_m3(const Scene& scene, const std::string& object);
double roof_area_m2(const Scene& scene, const std::string& object);
double top_m(const Scene& scene, const std::string& object);
double bottom_m(const Scene& scene, const std::string& object);
std::string material(const Scene& scene, const std::string& object);
bool has_object(const Scene& scene, const std::string& object);

}  // namespace wavetracer::test
