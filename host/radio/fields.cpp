// Delays, angles and coefficients of exact paths.
// Assumes that vertices lie in their surfaces to rounding error and that surface normals have unit length.
#include "radio/fields.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "radio/constants.hpp"
#include "radio/material.hpp"
#include "radio/slab.hpp"
#include "radio/transfer.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

struct FieldModel::Row {
  double delay_s, gain_db, doppler_hz;
  Matrix2 a;
  Angles aod, aoa;
};

namespace {

// Below this the direction of a leg is rounding error of its ends, and the law of reflection says it better.
constexpr double shortest_leg_m = 1e-6;

glm::dvec3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::vector<std::complex<double>> permittivities(const Scene& scene, double frequency_hz) {
  std::vector<std::complex<double>> result(scene.materials.size());
  std::vector<bool> known(scene.materials.size());
  for (const Surface& surface : scene.surfaces) {
    if (known[surface.material]) continue;
    known[surface.material] = true;
    result[surface.material] = complex_permittivity(scene.materials[surface.material], frequency_hz);
  }
  return result;
}

// Legs of one path: the first leaves the transmitter, the last arrives at the receiver.
struct Legs {
  double length_m = 0;
  std::vector<glm::dvec3> direction;
};

Legs legs_of(const Scene& scene, const PathGeometry& geometry, size_t path, const glm::dvec3& tx,
             const glm::dvec3& rx) {
  Legs legs;
  glm::dvec3 from = tx;
  const auto add = [&](const glm::dvec3& to, const glm::dvec3& continued) {
    const glm::dvec3 leg = to - from;
    const double length_m = glm::length(leg);
    legs.length_m += length_m;
    legs.direction.push_back(length_m > shortest_leg_m ? leg / length_m : continued);
    from = to;
  };
  glm::dvec3 continued{0};
  for (uint64_t i = geometry.first[path]; i < geometry.first[path + 1]; ++i) {
    add(geometry.vertex[i], continued);
    continued = legs.direction.back();
    if (geometry.interaction[i] == reflection) {
      continued = glm::reflect(continued, scene.surfaces[geometry.surface[i]].normal);
    }
  }
  add(rx, continued);
  return legs;
}

// The order of rows, complete: two paths that compare equal are the same path.
bool precedes(const PathGeometry& geometry, const std::vector<double>& delay_s, size_t p, size_t q) {
  const auto head = [&](size_t i) { return std::tuple(geometry.tx[i], geometry.rx[i], delay_s[i]); };
  if (head(p) != head(q)) return head(p) < head(q);
  const auto begin = [&](size_t i) { return static_cast<std::ptrdiff_t>(geometry.first[i]); };
  const auto compare = [&](const auto& values, const auto& less) {
    const auto at = values.begin();
    return std::lexicographical_compare(at + begin(p), at + begin(p + 1), at + begin(q), at + begin(q + 1), less) -
           std::lexicographical_compare(at + begin(q), at + begin(q + 1), at + begin(p), at + begin(p + 1), less);
  };
  if (const int order = compare(geometry.surface, std::less<>{})) return order > 0;
  if (const int order = compare(geometry.interaction, std::less<>{})) return order > 0;
  return compare(geometry.vertex, [](const glm::dvec3& a, const glm::dvec3& b) {
           return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
         }) > 0;
}

uint32_t most_ports(const auto& ends) {
  uint32_t ports = 1;
  for (const auto& end : ends) ports = std::max(ports, end.antenna.ports());
  return ports;
}

}  // namespace

FieldModel::FieldModel(const Scene& scene, const Config& config)
    : scene_(scene),
      wavelength_m_(speed_of_light_m_s / config.radio.frequency_hz),
      permittivity_(permittivities(scene, config.radio.frequency_hz)) {
  const auto make_ends = [&](const std::vector<RadioEnd>& ends) {
    std::vector<End> made;
    for (const RadioEnd& end : ends)
      made.push_back(
          {end.name, to_vector(end.position_m) - scene.origin_m, to_vector(end.velocity_m_s), make_antenna(end)});
    return made;
  };
  transmitters_ = make_ends(config.transmitters);
  receivers_ = make_ends(config.receivers);
  tx_ports_ = most_ports(transmitters_);
  rx_ports_ = most_ports(receivers_);
}

FieldModel::Row FieldModel::solve(const PathGeometry& geometry, size_t path) const {
  const End &tx = transmitters_[geometry.tx[path]], &rx = receivers_[geometry.rx[path]];
  const Legs legs = legs_of(scene_, geometry, path, tx.position, rx.position);
  const glm::dvec3 departure = legs.direction.front(), arrival = -legs.direction.back();
  if (departure == glm::dvec3{0}) {
    throw RuntimeError(
        fmt::format("transmitter \"{}\" stands in the very point where its path to receiver \"{}\" first "
                    "ends (a surface or that receiver); move it",
                    tx.name, rx.name));
  }

  Transfer transfer(basis_of(departure));
  for (uint64_t i = geometry.first[path], leg = 0; i < geometry.first[path + 1]; ++i, ++leg) {
    const Surface& surface = scene_.surfaces[geometry.surface[i]];
    const glm::dvec3 &k_in = legs.direction[leg], &k_out = legs.direction[leg + 1];
    const double cos_theta = std::min(std::abs(glm::dot(k_in, surface.normal)), 1.0);
    const SlabCoefficients slab = slab_coefficients(permittivity_[surface.material], cos_theta,
                                                    scene_.materials[surface.material].thickness_m, wavelength_m_);
    if (geometry.interaction[i] == reflection) {
      transfer.meet(k_in, k_out, surface.normal, slab.reflection_te, slab.reflection_tm);
    } else if (geometry.interaction[i] == transmission) {
      transfer.meet(k_in, k_out, surface.normal, slab.transmission_te, slab.transmission_tm);
    } else {
      throw RuntimeError(
          fmt::format("path {} has an interaction of kind {}: fields know reflection (1) and "
                      "transmission (4)",
                      path, geometry.interaction[i]));
    }
  }
  const Matrix2 m = transfer.seen_in(basis_of(arrival));

  Row row{.delay_s = legs.length_m / speed_of_light_m_s,
          .gain_db = 0,
          // Plus zero: ends that stand still give 0, not -0.
          .doppler_hz = (glm::dot(tx.velocity, departure) + glm::dot(rx.velocity, arrival)) / wavelength_m_ + 0.0,
          .a = {},
          .aod = angles_of(departure),
          .aoa = angles_of(arrival)};
  const double spreading = wavelength_m_ / (4 * std::numbers::pi * legs.length_m);
  double power = 0;
  for (uint32_t t = 0; t < tx.antenna.ports(); ++t) {
    const FieldPair sent = tx.antenna.field(t, departure);
    const FieldPair come{m[0] * sent.theta + m[1] * sent.phi, m[2] * sent.theta + m[3] * sent.phi};
    for (uint32_t r = 0; r < rx.antenna.ports(); ++r) {
      const FieldPair heard = rx.antenna.field(r, arrival);
      std::complex<double>& a = row.a[r * tx_ports_ + t];
      a = spreading * (heard.theta * come.theta + heard.phi * come.phi);
      power += std::norm(a);
    }
  }
  row.gain_db = 10 * std::log10(power);
  return row;
}

Paths FieldModel::compute(uint32_t frame, const PathGeometry& geometry) const {
  std::vector<Row> rows(geometry.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, rows.size(), 64), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t path = range.begin(); path < range.end(); ++path) rows[path] = solve(geometry, path);
  });

  std::vector<double> delay_s;
  for (const Row& row : rows) delay_s.push_back(row.delay_s);
  std::vector<size_t> order(rows.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t p, size_t q) { return precedes(geometry, delay_s, p, q); });

  Paths paths;
  paths.rx_ports = rx_ports_;
  paths.tx_ports = tx_ports_;
  for (const size_t path : order) {
    const Row& row = rows[path];
    paths.frame.push_back(frame);
    paths.tx.push_back(geometry.tx[path]);
    paths.rx.push_back(geometry.rx[path]);
    paths.depth.push_back(static_cast<uint32_t>(geometry.first[path + 1] - geometry.first[path]));
    paths.delay_s.push_back(row.delay_s);
    paths.gain_db.push_back(row.gain_db);
    paths.a.push_back(row.a);
    paths.aod_theta_rad.push_back(row.aod.theta_rad);
    paths.aod_phi_rad.push_back(row.aod.phi_rad);
    paths.aoa_theta_rad.push_back(row.aoa.theta_rad);
    paths.aoa_phi_rad.push_back(row.aoa.phi_rad);
    paths.doppler_hz.push_back(row.doppler_hz);
    for (uint64_t i = geometry.first[path]; i < geometry.first[path + 1]; ++i) {
      paths.vertex_position_m.push_back(geometry.vertex[i] + scene_.origin_m);
      paths.vertex_interaction.push_back(geometry.interaction[i]);
      paths.vertex_surface.push_back(geometry.surface[i]);
      paths.vertex_instance.push_back(no_instance);
    }
    paths.vertex_offset.push_back(paths.vertex_position_m.size());
  }
  return paths;
}

Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry) {
  return FieldModel(scene, config).compute(frame, geometry);
}

}  // namespace wavetracer
