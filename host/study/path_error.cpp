// SPDX-License-Identifier: Apache-2.0
// Both frames are sorted by link and sequence, then merged like two lists.
// Sums run in that order, so that equal frames give errors of exactly zero.
#include "study/path_error.hpp"
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>
#include "output/median.hpp"
#include "radio/path_power.hpp"

namespace wavetracer::study {
namespace {

constexpr double speed_of_light_m_s = 299792458;

double share(double part, double whole) { return whole > 0 ? part / whole : undefined; }

// Returns what a vertex touches: numbers of surfaces are those of one model; edges have their own numbers.
auto touched(const Paths& paths, uint64_t vertex) {
  return std::tuple(paths.vertex_surface[vertex], paths.vertex_instance[vertex], paths.vertex_interaction[vertex]);
}

// Returns a negative number, zero or a positive number if path i of a comes before, equals, or comes after path j of b.
int compare(const Paths& a, size_t i, const Paths& b, size_t j) {
  if (a.tx[i] != b.tx[j]) return a.tx[i] < b.tx[j] ? -1 : 1;
  if (a.rx[i] != b.rx[j]) return a.rx[i] < b.rx[j] ? -1 : 1;
  uint64_t k = a.vertex_offset[i], m = b.vertex_offset[j];
  const uint64_t end_a = a.vertex_offset[i + 1], end_b = b.vertex_offset[j + 1];
  for (; k < end_a && m < end_b; ++k, ++m)
    if (const auto order = touched(a, k) <=> touched(b, m); order != 0) return order < 0 ? -1 : 1;
  return k < end_a ? 1 : m < end_b ? -1 : 0;
}

std::vector<size_t> sorted(const Paths& paths) {
  std::vector<size_t> order(paths.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return compare(paths, i, paths, j) < 0; });
  return order;
}

struct LinkPaths {
  std::vector<double> delays_s, dopplers_hz, powers;
  double power() const { return std::accumulate(powers.begin(), powers.end(), 0.0); }
};

std::map<std::pair<uint32_t, uint32_t>, LinkPaths> links_of(const Paths& paths, const std::vector<size_t>& order) {
  std::map<std::pair<uint32_t, uint32_t>, LinkPaths> links;
  for (const size_t path : order) {
    LinkPaths& link = links[{paths.tx[path], paths.rx[path]}];
    link.delays_s.push_back(paths.delay_s[path]);
    link.dopplers_hz.push_back(paths.doppler_hz[path]);
    link.powers.push_back(power_of(paths, path));
  }
  return links;
}

void compare_paths(const Paths& reference, const std::vector<size_t>& a, const Paths& paths,
                   const std::vector<size_t>& b, PathError& out) {
  double total = 0, lost_power = 0, spurious_power = 0, delays_s = 0;
  for (const size_t path : a) total += power_of(reference, path);
  for (size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const int order = i == a.size() ? 1 : j == b.size() ? -1 : compare(reference, a[i], paths, b[j]);
    if (order < 0) {
      ++out.lost;
      lost_power += power_of(reference, a[i++]);
    } else if (order > 0) {
      ++out.spurious;
      spurious_power += power_of(paths, b[j++]);
    } else {
      ++out.paired;
      delays_s += std::abs(paths.delay_s[b[j++]] - reference.delay_s[a[i++]]);
    }
  }
  const auto count = static_cast<double>(a.size());
  out.reference_paths = a.size();
  out.lost_share = share(static_cast<double>(out.lost), count);
  out.spurious_share = share(static_cast<double>(out.spurious), count);
  out.lost_power = share(lost_power, total);
  out.spurious_power = share(spurious_power, total);
  out.delay_ns = share(1e9 * delays_s, static_cast<double>(out.paired));
}

void compare_links(const Paths& reference, const std::vector<size_t>& a, const Paths& paths,
                   const std::vector<size_t>& b, PathError& out) {
  const auto links_a = links_of(reference, a), links_b = links_of(paths, b);
  std::vector<double> errors_db;
  double spreads_ns = 0, spreads_hz = 0;
  for (const auto& [ends, link] : links_a) {
    const auto found = links_b.find(ends);
    if (found == links_b.end()) {
      ++out.links_lost;
      continue;
    }
    const LinkPaths& other = found->second;
    errors_db.push_back(std::abs(share_db(other.power()) - share_db(link.power())));
    spreads_ns += 1e9 * std::abs(rms_spread(other.delays_s, other.powers) - rms_spread(link.delays_s, link.powers));
    spreads_hz += std::abs(rms_spread(other.dopplers_hz, other.powers) - rms_spread(link.dopplers_hz, link.powers));
  }
  out.links = errors_db.size();
  out.links_spurious = links_b.size() - out.links;
  if (errors_db.empty()) return;
  out.power_median_db = median(errors_db);
  out.power_max_db = *std::ranges::max_element(errors_db);
  out.delay_spread_ns = spreads_ns / static_cast<double>(out.links);
  out.doppler_spread_hz = spreads_hz / static_cast<double>(out.links);
}

// Returns the centroid of all vertices, in the order of the paths.
glm::dvec3 centroid(const Paths& paths, const std::vector<size_t>& order) {
  glm::dvec3 sum{0};
  double count = 0;
  for (const size_t path : order)
    for (uint64_t vertex = paths.vertex_offset[path]; vertex < paths.vertex_offset[path + 1]; ++vertex, ++count)
      sum += paths.vertex_position_m[vertex];
  return count > 0 ? sum / count : glm::dvec3(undefined);
}

}  // namespace

double share_db(double share) { return 10 * std::log10(share); }

double rms_spread(std::span<const double> values, std::span<const double> powers) {
  double total = 0, mean = 0, squares = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    total += powers[i];
    mean += powers[i] * values[i];
  }
  if (!(total > 0)) return undefined;
  mean /= total;
  for (size_t i = 0; i < values.size(); ++i) squares += powers[i] * (values[i] - mean) * (values[i] - mean);
  return std::sqrt(squares / total);
}

PathError path_error(const Paths& reference, const Paths& paths) {
  if (reference.rx_ports != paths.rx_ports || reference.tx_ports != paths.tx_ports)
    throw std::invalid_argument("path_error: frames with different ports");
  const std::vector<size_t> a = sorted(reference), b = sorted(paths);
  PathError out;
  compare_paths(reference, a, paths, b, out);
  compare_links(reference, a, paths, b, out);
  const glm::dvec3 apart = glm::abs(centroid(paths, b) - centroid(reference, a));
  out.l1_m = apart.x + apart.y + apart.z;
  out.l2_m = glm::length(apart);
  double delays_s = 0;
  for (const size_t path : a) delays_s += reference.delay_s[path];
  out.mean_path_length_m = share(speed_of_light_m_s * delays_s, static_cast<double>(a.size()));
  out.l1_relative = out.l1_m / out.mean_path_length_m;
  out.l2_relative = out.l2_m / out.mean_path_length_m;
  return out;
}

void PathErrorMean::add(const PathError& error) {
  for (uint64_t PathError::*count :
       {&PathError::reference_paths, &PathError::paired, &PathError::lost, &PathError::spurious, &PathError::links,
        &PathError::links_lost, &PathError::links_spurious})
    sums_.*count += error.*count;
  if (!(error.power_max_db <= sums_.power_max_db) && !std::isnan(error.power_max_db))
    sums_.power_max_db = error.power_max_db;
  for (size_t i = 0; i < averaged.size(); ++i)
    if (const double value = error.*averaged[i]; !std::isnan(value)) means_[i].add(value);
}

PathError PathErrorMean::mean() const {
  PathError out = sums_;
  const auto whole = static_cast<double>(out.reference_paths);
  out.lost_share = share(static_cast<double>(out.lost), whole);
  out.spurious_share = share(static_cast<double>(out.spurious), whole);
  for (size_t i = 0; i < averaged.size(); ++i) out.*averaged[i] = means_[i].mean();
  return out;
}

}  // namespace wavetracer::study
