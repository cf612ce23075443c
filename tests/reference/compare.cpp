// SPDX-License-Identifier: Apache-2.0
// Reads reference lists with nlohmann/json and matches paths against them.
// Quadratic within one link, which is small: the largest lists have some hundred paths per link.
#include "reference/compare.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer::reference {
namespace {

using glm::dvec3;
using Json = nlohmann::json;

constexpr double vertex_tolerance_m = 0.3;
constexpr double delay_tolerance = 2e-6;      // relative
constexpr double delay_tolerance_s = 30e-12;  // or this, whichever is larger
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

dvec3 to_point(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

std::vector<dvec3> to_points(const Json& json) {
  std::vector<dvec3> points;
  for (const Json& point : json) points.push_back(to_point(point));
  return points;
}

std::span<const dvec3> vertices(const Paths& paths, size_t i) {
  return std::span(paths.vertex_position_m)
      .subspan(paths.vertex_offset[i], paths.vertex_offset[i + 1] - paths.vertex_offset[i]);
}

std::span<const uint8_t> interactions(const Paths& paths, size_t i) {
  return std::span(paths.vertex_interaction)
      .subspan(paths.vertex_offset[i], paths.vertex_offset[i + 1] - paths.vertex_offset[i]);
}

std::span<const std::complex<double>> coefficients(const Paths& paths, size_t i) {
  return std::span(paths.a[i]).first(size_t{paths.rx_ports} * paths.tx_ports);
}

double power(const Paths& paths, size_t i) {
  double sum = 0;
  for (const auto& a : coefficients(paths, i)) sum += std::norm(a);
  return sum;
}

void append_path(Paths& paths, const Json& json) {
  paths.frame.push_back(0);
  paths.tx.push_back(json.at("tx"));
  paths.rx.push_back(json.at("rx"));
  paths.delay_s.push_back(json.at("tau_s"));
  auto& a = paths.a.emplace_back();
  for (size_t r = 0; r < 2; ++r)
    for (size_t t = 0; t < 2; ++t) a[2 * r + t] = {json.at("a_re").at(r).at(t), json.at("a_im").at(r).at(t)};
  paths.gain_db.push_back(10 * std::log10(power(paths, paths.a.size() - 1)));
  paths.aod_theta_rad.push_back(json.at("aod_theta_phi_rad").at(0));
  paths.aod_phi_rad.push_back(json.at("aod_theta_phi_rad").at(1));
  paths.aoa_theta_rad.push_back(json.at("aoa_theta_phi_rad").at(0));
  paths.aoa_phi_rad.push_back(json.at("aoa_theta_phi_rad").at(1));
  paths.doppler_hz.push_back(0);
  const auto points = to_points(json.at("vertices_m"));
  const auto kinds = json.at("interactions").get<std::vector<uint8_t>>();
  if (points.size() != kinds.size()) throw InputError("a path has unequal numbers of vertices and interactions");
  paths.depth.push_back(static_cast<uint32_t>(kinds.size()));
  paths.vertex_position_m.insert(paths.vertex_position_m.end(), points.begin(), points.end());
  paths.vertex_interaction.insert(paths.vertex_interaction.end(), kinds.begin(), kinds.end());
  paths.vertex_surface.resize(paths.vertex_position_m.size(), 0);
  paths.vertex_instance.resize(paths.vertex_position_m.size(), no_instance);
  paths.vertex_offset.push_back(paths.vertex_position_m.size());
}

// The percentile q in [0, 1] with linear interpolation between ranks, NumPy's default.
double percentile(std::vector<double> values, double q) {
  if (values.empty()) return nan;
  std::sort(values.begin(), values.end());
  const double rank = q * static_cast<double>(values.size() - 1);
  const size_t below = static_cast<size_t>(rank), above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
}

using LinkKey = std::tuple<uint32_t, uint32_t, std::vector<uint8_t>>;  // tx, rx, interactions

LinkKey key_of(const Paths& paths, size_t i) {
  const auto kinds = interactions(paths, i);
  return {paths.tx[i], paths.rx[i], {kinds.begin(), kinds.end()}};
}

// The largest distance between corresponding vertices, or nothing if the delays or a vertex disagree.
std::optional<double> distance(const Paths& mine, size_t i, const Paths& theirs, size_t j) {
  const double tolerance_s = std::max(delay_tolerance * theirs.delay_s[j], delay_tolerance_s);
  if (std::abs(mine.delay_s[i] - theirs.delay_s[j]) > tolerance_s) return std::nullopt;
  double largest = 0;
  const auto a = vertices(mine, i), b = vertices(theirs, j);
  for (size_t k = 0; k < a.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(a[k][axis] - b[k][axis]));
  if (largest > vertex_tolerance_m) return std::nullopt;
  return largest;
}

// The names of interactions whose bits are set, joined by " + ".
std::string names_of(uint32_t bits) {
  std::string names;
  for (const InteractionKind& kind : interaction_kinds)
    if (bits & kind.code) names += (names.empty() ? "" : " + ") + std::string(kind.word);
  return names;
}

// The interactions of a path besides reflection, or "specular".
std::string kind_of(const Paths& paths, size_t i) {
  uint32_t bits = 0;
  for (const uint8_t kind : interactions(paths, i)) bits |= kind;
  const std::string names = names_of(bits & ~uint32_t{reflection});
  return names.empty() ? "specular" : names;
}

// Sums for an Agreement.
struct Tally {
  size_t reference = 0, extra = 0;
  double power_all = 0, power_found = 0, power_extra = 0;
  std::vector<double> delay_errors, gain_errors, matrix_errors;  // errors of matched paths

  // Path j of the list, and path i of ours that matches it.
  void add_reference(const Paths& theirs, size_t j, const Paths& mine, std::optional<size_t> i) {
    const double p = power(theirs, j);
    ++reference;
    power_all += p;
    if (!i) return;
    power_found += p;
    delay_errors.push_back(std::abs(mine.delay_s[*i] - theirs.delay_s[j]) / theirs.delay_s[j]);
    if (mine.rx_ports != theirs.rx_ports || mine.tx_ports != theirs.tx_ports) return;
    gain_errors.push_back(std::abs(10 * std::log10(std::max(power(mine, *i), 1e-300) / p)));
    double difference = 0;
    for (size_t k = 0; k < 4; ++k) difference += std::norm(mine.a[*i][k] - theirs.a[j][k]);
    matrix_errors.push_back(std::sqrt(difference / p));
  }

  void add_extra(const Paths& mine, size_t i) {
    ++extra;
    power_extra += power(mine, i);
  }

  Agreement agreement() const {
    Agreement result;
    result.reference = reference;
    result.found = delay_errors.size();
    result.mine = result.found + extra;
    result.recall = static_cast<double>(result.found) / static_cast<double>(std::max<size_t>(reference, 1));
    result.power_recall = power_found / std::max(power_all, 1e-300);
    result.extra = extra;
    result.extra_power_ratio = power_extra / std::max(power_all, 1e-300);
    result.delay_rel_err_max = percentile(delay_errors, 1);
    result.gain_err_db_p50 = percentile(gain_errors, 0.5);
    result.gain_err_db_p99 = percentile(gain_errors, 0.99);
    result.gain_err_db_max = percentile(gain_errors, 1);
    result.matrix_rel_err_p50 = percentile(matrix_errors, 0.5);
    result.matrix_rel_err_p99 = percentile(matrix_errors, 0.99);
    return result;
  }
};

std::string line(const Agreement& a) {
  return fmt::format(
      "found {} of {} (recall {:.4f}, of the power {:.6f}), {} extra, delay error max {:.2g}, "
      "gain error p50 {:.2g} p99 {:.2g} max {:.2g} dB, matrix error p50 {:.2g} p99 {:.2g}",
      a.found, a.reference, a.recall, a.power_recall, a.extra, a.delay_rel_err_max, a.gain_err_db_p50,
      a.gain_err_db_p99, a.gain_err_db_max, a.matrix_rel_err_p50, a.matrix_rel_err_p99);
}

size_t count_duplicates(const Paths& paths) {
  std::set<std::tuple<LinkKey, int64_t, std::vector<int64_t>>> seen;
  size_t duplicates = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    std::vector<int64_t> rounded;
    for (const dvec3& p : vertices(paths, i))
      for (int axis = 0; axis < 3; ++axis) rounded.push_back(std::llround(p[axis] * 1e4));
    duplicates += !seen.emplace(key_of(paths, i), std::llround(paths.delay_s[i] * 1e13), rounded).second;
  }
  return duplicates;
}

}  // namespace

Case load_case(const std::filesystem::path& json_path) {
  std::ifstream in(json_path);
  if (!in) throw InputError(fmt::format("cannot read the reference list {}", json_path.string()));
  try {
    const Json json = Json::parse(in);
    Case result;
    result.name = json.at("case");
    result.scene = json.at("scene");
    result.frequency_hz = json.at("frequency_hz");
    result.max_depth = json.at("max_depth");
    result.reflection = json.at("reflection");
    result.transmission = json.at("transmission");
    result.diffraction = json.at("diffraction");
    result.transmitters_m = to_points(json.at("tx_m"));
    result.receivers_m = to_points(json.at("rx_m"));
    result.paths.rx_ports = result.paths.tx_ports = 2;
    for (const Json& path : json.at("paths")) append_path(result.paths, path);
    return result;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{} is not a reference list: {}", json_path.string(), error.what()));
  }
}

Comparison compare_paths(const std::filesystem::path& json_path, const Paths& paths) {
  return compare_paths(load_case(json_path), paths);
}

Comparison compare_paths(const Case& reference, const Paths& paths) {
  const Paths& theirs = reference.paths;
  std::map<LinkKey, std::vector<size_t>> mine;
  for (size_t i = 0; i < paths.size(); ++i) mine[key_of(paths, i)].push_back(i);
  std::vector<bool> used(paths.size(), false);
  Comparison result;
  Tally all;
  std::map<std::string, Tally> kinds;
  for (size_t j = 0; j < theirs.size(); ++j) {
    std::optional<size_t> best;
    double best_distance = 0;
    for (const size_t i : mine[key_of(theirs, j)]) {
      const auto d = used[i] ? std::nullopt : distance(paths, i, theirs, j);
      if (d && (!best || *d < best_distance)) best = i, best_distance = *d;
    }
    if (best)
      used[*best] = true;
    else
      result.missing.push_back(j);
    for (Tally* tally : {&all, &kinds[kind_of(theirs, j)]}) tally->add_reference(theirs, j, paths, best);
  }
  for (size_t i = 0; i < paths.size(); ++i) {
    if (used[i]) continue;
    result.extra_paths.push_back(i);
    for (Tally* tally : {&all, &kinds[kind_of(paths, i)]}) tally->add_extra(paths, i);
  }
  static_cast<Agreement&>(result) = all.agreement();
  for (const auto& [kind, tally] : kinds) result.kinds[kind] = tally.agreement();
  result.duplicates = count_duplicates(paths);
  return result;
}

std::string to_string(const Comparison& c) {
  std::string text = fmt::format("{}, {} duplicates", line(c), c.duplicates);
  if (c.kinds.size() > 1)
    for (const auto& [kind, agreement] : c.kinds) text += fmt::format("\n  {}: {}", kind, line(agreement));
  return text;
}

std::string to_string(const Paths& paths, size_t i) {
  std::string text = fmt::format("tx {} rx {}, {:.4f} ns, {:.2f} dB", paths.tx[i], paths.rx[i], paths.delay_s[i] * 1e9,
                                 10 * std::log10(std::max(power(paths, i), 1e-300)));
  const auto points = vertices(paths, i);
  for (size_t k = 0; k < points.size(); ++k)
    text += fmt::format(", {} ({:.4f}, {:.4f}, {:.4f})", names_of(interactions(paths, i)[k]), points[k].x, points[k].y,
                        points[k].z);
  return text;
}

}  // namespace wavetracer::reference
