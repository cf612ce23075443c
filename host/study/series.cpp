// SPDX-License-Identifier: Apache-2.0
// Makes series from the methods of wavetracer/order_methods.hpp.
#include "study/series.hpp"
#include <algorithm>
#include <stdexcept>
#include "wavetracer/order_methods.hpp"

namespace wavetracer::study {
namespace {

OrderMethodRow row_of(const std::string& method) {
  const auto row = find_order_method(OrderMethod::named(method));
  if (!row) throw std::logic_error("no order is called " + method);
  return *row;
}

// Returns the shape in which a method is launched by default.
std::string own_shape(const OrderMethodRow& method) {
  return std::to_string(std::max(method.launch_dimensions, 1u)) + "d";
}

}  // namespace

Series unordered() { return ordered("none"); }

Series ordered(const std::string& method) {
  const OrderMethodRow row = row_of(method);
  return {row.mnemonic.text(), row.name.text(), "random", own_shape(row)};
}

Series born_ordered() { return {"born ordered", "none", "hilbert", "1d"}; }

Series with_shape(Series series, const std::string& shape) {
  series.shape = shape;
  return series;
}

Series with_bins(Series series, uint32_t bins) {
  series.bins = bins;
  return series;
}

std::vector<Series> with_finer_bins(std::vector<Series> series, const std::vector<std::string>& methods) {
  for (const uint32_t bins : {32u, 64u, 128u})
    for (const std::string& method : methods) series.push_back(with_bins(ordered(method), bins));
  return series;
}

bool has_bins(const Series& series) { return series.method.find("histogram") != std::string::npos; }

std::string label(const Series& series) {
  return series.mnemonic + (series.shape == own_shape(row_of(series.method)) ? "" : " " + series.shape) +
         (series.bins == thesis_bins ? "" : " " + std::to_string(series.bins) + " bins");
}

const std::vector<std::string>& series_keys() {
  static const std::vector<std::string> keys = {"trace.rays",       "trace.directions", "order.method",
                                                "order.each_depth", "order.bin_num",    "launch.shape"};
  return keys;
}

void apply(Config& config, const Series& series, uint64_t rays) {
  config.trace.rays = rays;
  config.trace.directions = Directions::named(series.directions);
  config.order.method = OrderMethod::named(series.method);
  config.order.each_depth = series.each_depth;
  config.order.bin_num = series.bins;
  config.launch.shape = LaunchDimensions::named(series.shape);
}

}  // namespace wavetracer::study
