// SPDX-License-Identifier: Apache-2.0
// Reads the polygons, points and lines of all features of a vector map by OGR.
// Curves become lines, collections become their parts; heights of points are not used here.
#include <cpl_error.h>
#include <ogr_api.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "maps/module.hpp"

namespace wavetracer::maps {
namespace {

using Visit = int (*)(void*, const wt_maps_shape*);

struct Free {
  void operator()(OGRGeometryH geometry) const { OGR_G_DestroyGeometry(geometry); }
};
struct FreeFeature {
  void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};

class LayerReader {
 public:
  LayerReader(const wt_maps_query& query, Visit visit, void* user, wt_maps_layers& layers)
      : query_(query), visit_(visit), user_(user), layers_(layers) {}

  // Returns whether everything was read.
  bool read(OGRLayerH layer, bool as_they_are) {
    name_ = OGR_L_GetName(layer);
    transformation_ = as_they_are ? Transformation() : to_degrees(OGR_L_GetSpatialRef(layer));
    find_fields(OGR_L_GetLayerDefn(layer));
    OGR_L_ResetReading(layer);
    CPLErrorReset();
    while (const std::unique_ptr<void, FreeFeature> feature{OGR_L_GetNextFeature(layer)}) {
      ++layers_.features;
      if (!take(feature.get())) return false;
    }
    if (CPLGetLastErrorType() >= CE_Failure) throw std::runtime_error("layer '" + name_ + "': " + CPLGetLastErrorMsg());
    return true;
  }

 private:
  void find_fields(OGRFeatureDefnH definition) {
    std::vector<std::string> names;
    std::string all = layers_.fields;
    for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i) {
      names.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i)));
      all += (all.empty() ? "" : ", ") + names.back();
    }
    put(layers_.fields, all);
    columns_.assign(query_.field_count, -1);
    for (size_t k = 0; k < query_.field_count; ++k) {
      columns_[k] = find_field(names, k);
      if (columns_[k] >= 0) layers_.found |= 1u << k;
    }
  }

  // Returns the field with exactly this name, or else the first one that differs by case alone.
  int find_field(const std::vector<std::string>& names, size_t k) {
    const char* const wanted = query_.fields[k];
    int exact = -1, alike = -1;
    size_t exact_count = 0, alike_count = 0;
    for (size_t i = 0; i < names.size(); ++i) {
      if (names[i] == wanted && exact_count++ == 0) exact = static_cast<int>(i);
      if (EQUAL(names[i].c_str(), wanted) && alike_count++ == 0) alike = static_cast<int>(i);
    }
    if ((exact_count > 0 ? exact_count : alike_count) > 1) layers_.ambiguous |= 1u << k;
    return exact_count > 0 ? exact : alike;
  }

  bool take(OGRFeatureH feature) {
    const OGRGeometryH stored = OGR_F_GetGeometryRef(feature);
    const std::unique_ptr<void, Free> linear(stored ? OGR_G_GetLinearGeometry(stored, 0, nullptr) : nullptr);
    values_.clear();
    for (const int column : columns_)
      values_.push_back(column >= 0 && OGR_F_IsFieldSetAndNotNull(feature, column)
                            ? OGR_F_GetFieldAsString(feature, column)
                            : nullptr);
    // Texts of fields are overwritten by the next call.
    texts_.assign(values_.size(), "");
    for (size_t k = 0; k < columns_.size(); ++k)
      if (values_[k]) texts_[k] = OGR_F_GetFieldAsString(feature, columns_[k]);
    for (size_t k = 0; k < columns_.size(); ++k)
      if (values_[k]) values_[k] = texts_[k].c_str();
    feature_ = OGR_F_GetFID(feature);
    part_ = 0;
    const bool all = !linear || take_geometry(linear.get(), 0);
    if (part_ == 0) ++layers_.no_shapes;
    return all;
  }

  bool take_geometry(OGRGeometryH geometry, int depth) {
    constexpr int deepest = 16;  // nesting of collections
    const OGRwkbGeometryType type = OGR_GT_Flatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbPolygon) return take_polygon(geometry);
    if (type == wkbPoint) return take_shape(WT_MAPS_POINT, {geometry});
    if (type == wkbLineString) return take_shape(WT_MAPS_LINE, {geometry});
    const bool several =
        type == wkbMultiPolygon || type == wkbMultiPoint || type == wkbMultiLineString || type == wkbGeometryCollection;
    if (depth == deepest || !several) return true;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
      if (!take_geometry(OGR_G_GetGeometryRef(geometry, i), depth + 1)) return false;
    return true;
  }

  bool take_polygon(OGRGeometryH polygon) {
    std::vector<OGRGeometryH> rings;
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) rings.push_back(OGR_G_GetGeometryRef(polygon, i));
    return take_shape(WT_MAPS_POLYGON, rings);
  }

  // parts: the rings of a polygon, or a point or line itself.
  bool take_shape(int kind, const std::vector<OGRGeometryH>& parts) {
    std::vector<size_t> sizes;
    size_t points = 0;
    for (const OGRGeometryH part : parts) {
      const int count = OGR_G_GetPointCount(part);
      if (count <= 0) continue;
      sizes.push_back(static_cast<size_t>(count));
      points += sizes.back();
    }
    if (sizes.empty()) return true;
    ++part_;
    if (points > query_.most_points) {
      ++layers_.too_large;
      return true;
    }
    std::vector<double> x(points), y(points);
    size_t first = 0;
    for (const OGRGeometryH part : parts) {
      const int count = OGR_G_GetPointCount(part);
      if (count <= 0) continue;
      OGR_G_GetPoints(part, &x[first], sizeof(double), &y[first], sizeof(double), nullptr, 0);
      first += static_cast<size_t>(count);
    }
    if (transformation_) {
      std::vector<int> good(points);
      OCTTransformEx(transformation_.get(), static_cast<int>(points), x.data(), y.data(), nullptr, good.data());
      for (size_t i = 0; i < points; ++i)
        if (!good[i]) x[i] = y[i] = NAN;
    }
    std::vector<double> xy;
    for (size_t i = 0; i < points; ++i) {
      xy.push_back(x[i]);
      xy.push_back(y[i]);
    }
    const wt_maps_shape out{kind,         name_.c_str(), feature_,  part_ - 1,
                            sizes.size(), sizes.data(),  xy.data(), values_.data()};
    return visit_(user_, &out) == 0;
  }

  const wt_maps_query& query_;
  Visit visit_;
  void* user_;
  wt_maps_layers& layers_;
  std::string name_;
  Transformation transformation_;
  std::vector<int> columns_;  // columns of the query's fields in the layer; -1 if it has none
  std::vector<std::string> texts_;
  std::vector<const char*> values_;
  int64_t feature_ = 0;
  size_t part_ = 0;
};

std::vector<OGRLayerH> layers_of(GDALDatasetH dataset, const char* wanted) {
  std::vector<OGRLayerH> out;
  std::string names;
  for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
    const OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
    const std::string name = OGR_L_GetName(layer);
    names += (names.empty() ? "" : ", ") + name;
    if (!wanted || name == wanted) out.push_back(layer);
  }
  if (out.empty())
    throw std::runtime_error(wanted ? "it has no layer '" + std::string(wanted) + "'; layers are " + names
                                    : "it has no layer");
  return out;
}

void read_all(GDALDatasetH dataset, const wt_maps_query& query, Visit visit, void* user, wt_maps_layers& layers) {
  const std::vector<OGRLayerH> all = layers_of(dataset, query.layer);
  size_t on_earth = 0;
  for (const OGRLayerH layer : all) on_earth += to_degrees(OGR_L_GetSpatialRef(layer)) != nullptr;
  layers.in_degrees = on_earth > 0;
  LayerReader reader(query, visit, user, layers);
  for (const OGRLayerH layer : all) {
    if (on_earth > 0 && !to_degrees(OGR_L_GetSpatialRef(layer))) continue;  // tables without a place, beside the map
    if (!reader.read(layer, on_earth == 0)) return;
  }
}

}  // namespace
}  // namespace wavetracer::maps

WT_MAPS_PUBLIC int wt_maps_shapes(const char* file, const wt_maps_query* query,
                                  int (*visit)(void*, const wt_maps_shape*), void* user, wt_maps_layers* layers,
                                  char error[WT_MAPS_ERROR_SIZE]) {
  using namespace wavetracer::maps;
  *layers = {};
  return guarded(error, [&] {
    const Dataset dataset = open(file, GDAL_OF_VECTOR);
    put(layers->driver, driver_of(dataset.get()));
    read_all(dataset.get(), *query, visit, user, *layers);
  });
}
