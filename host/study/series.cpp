// The methods and their mnemonics.
// Assumes the method names of the field table (host/config/field_table.cpp).
#include "study/series.hpp"
#include <stdexcept>

namespace wavetracer::study {
namespace {

struct Method {
  std::string name, mnemonic, shape;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"none", "WS", "1d"},
      {"morton", "Z", "1d"},
      {"hilbert3d-histogram", "H3DH", "1d"},
      {"morton-histogram", "HZ", "1d"},
      {"hilbert3d-histogram-hilbert2d", "H3DH2DH", "2d"},
      {"hilbert3d-histogram-hilbert3d", "H3DH3DH", "3d"},
      {"direction-origin", "direction-origin", "1d"},
  };
  return all;
}

const Method& find(const std::string& name) {
  for (const Method& method : methods())
    if (method.name == name) return method;
  throw std::logic_error("no method of order is called " + name);
}

}  // namespace

Series unordered() { return ordered("none"); }

Series ordered(const std::string& method) {
  const Method& m = find(method);
  return {m.mnemonic, m.name, "random", m.shape};
}

Series born_ordered() { return {"born ordered", "none", "hilbert", "1d"}; }

Series with_shape(Series series, const std::string& shape) {
  series.shape = shape;
  return series;
}

std::string label(const Series& series) {
  return series.mnemonic + (series.shape == find(series.method).shape ? "" : " " + series.shape);
}

const std::vector<std::string>& series_keys() {
  static const std::vector<std::string> keys = {"trace.rays", "trace.directions", "order.method", "order.each_depth",
                                                "launch.shape"};
  return keys;
}

void apply(Config& config, const Series& series, uint64_t rays) {
  config.trace.rays = rays;
  config.trace.directions = Directions::named(series.directions);
  config.order.method = OrderMethod::named(series.method);
  config.order.each_depth = series.each_depth;
  config.launch.shape = LaunchDimensions::named(series.shape);
}

}  // namespace wavetracer::study
