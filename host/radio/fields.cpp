// Delays, angles and coefficients of exact paths: first all lengths, which order the rows, then row by row in place.
// Rows are independent of each other, and all but the grouping by link runs on all cores.
#include "radio/fields.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radio/constants.hpp"
#include "radio/link_groups.hpp"

namespace wavetracer {
namespace {

glm::dvec3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// The order of rows of one link, complete: two paths that compare equal are the same path.
bool precedes(const PathGeometry& geometry, const std::vector<double>& delay_s, uint32_t p, uint32_t q) {
  if (delay_s[p] != delay_s[q]) return delay_s[p] < delay_s[q];
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

// Paths in the order of rows.
std::vector<uint32_t> ordered(const PathGeometry& geometry, const std::vector<double>& delay_s) {
  LinkGroups links = group_by_link(geometry.tx, geometry.rx);
  tbb::parallel_for(size_t{0}, links.size(), [&](size_t link) {
    std::ranges::sort(links.rows(link), [&](uint32_t p, uint32_t q) { return precedes(geometry, delay_s, p, q); });
  });
  return std::move(links.row);
}

// Is there a path of these interactions among the rows of the link, as long as this row's to a picosecond?
bool has_sibling(const PathGeometry& geometry, const std::vector<double>& delay_s, const std::vector<uint32_t>& order,
                 size_t row, std::span<const uint32_t> surfaces, std::span<const uint8_t> interactions) {
  const uint32_t path = order[row];
  const auto near = [&](size_t other) {
    const uint32_t p = order[other];
    return geometry.tx[p] == geometry.tx[path] && geometry.rx[p] == geometry.rx[path] &&
           std::abs(delay_s[p] - delay_s[path]) < 1e-12;
  };
  const auto same = [&](size_t other) {
    const uint64_t first = geometry.first[order[other]], count = geometry.first[order[other] + 1] - first;
    return std::ranges::equal(std::span(geometry.surface).subspan(first, count), surfaces) &&
           std::ranges::equal(std::span(geometry.interaction).subspan(first, count), interactions);
  };
  size_t begin = row, end = row + 1;
  while (begin > 0 && near(begin - 1)) --begin;
  while (end < order.size() && near(end)) ++end;
  for (size_t other = begin; other < end; ++other)
    if (same(other)) return true;
  return false;
}

// Columns of this many rows and vertices. Most of the time goes to pages that are touched first, so cores share it.
void resize(Paths& paths, size_t rows, size_t vertices) {
  tbb::parallel_invoke(
      [&] { paths.a.resize(rows); },
      [&] {
        for (auto* column : {&paths.frame, &paths.tx, &paths.rx, &paths.depth}) column->resize(rows);
      },
      [&] {
        for (auto* column : {&paths.delay_s, &paths.gain_db, &paths.doppler_hz}) column->resize(rows);
      },
      [&] {
        for (auto* column : {&paths.aod_theta_rad, &paths.aod_phi_rad, &paths.aoa_theta_rad, &paths.aoa_phi_rad})
          column->resize(rows);
      },
      [&] { paths.vertex_position_m.resize(vertices); },
      [&] {
        paths.vertex_interaction.resize(vertices);
        paths.vertex_surface.resize(vertices);
        paths.vertex_instance.resize(vertices);
      },
      [&] { paths.vertex_offset.resize(rows + 1); });
}

uint32_t most_ports(const std::vector<Antenna>& antennas) {
  uint32_t ports = 1;
  for (const Antenna& antenna : antennas) ports = std::max(ports, antenna.ports());
  return ports;
}

}  // namespace

FieldModel::FieldModel(const Scene& scene, const Config& config, std::span<const Scene> models,
                       std::span<const Instance> instances)
    : interactions_(scene, config, models, instances), origin_m_(scene.origin_m) {
  const auto make_ends = [&](const std::vector<RadioEnd>& ends, std::vector<Antenna>& made,
                             std::vector<EndState>& still) {
    for (const RadioEnd& end : ends) {
      made.push_back(make_antenna(end));
      still.push_back({.position_m = to_vector(end.position_m) - scene.origin_m,
                       .rotation = made.back().rotation(),
                       .velocity_m_s = to_vector(end.velocity_m_s)});
    }
  };
  make_ends(config.transmitters, transmitters_, still_.transmitters);
  make_ends(config.receivers, receivers_, still_.receivers);
  tx_ports_ = most_ports(transmitters_);
  rx_ports_ = most_ports(receivers_);
}

void FieldModel::evaluate(const PathGeometry& geometry, size_t path, const WorldState& state, const Legs& legs,
                          const SiblingQuestion& sibling, Paths& paths, size_t row) const {
  const Antenna &tx = transmitters_[geometry.tx[path]], &rx = receivers_[geometry.rx[path]];
  const glm::dvec3 departure = legs.directions().front(), arrival = -legs.directions().back();
  const uint64_t first = geometry.first[path], first_vertex = paths.vertex_offset[row];
  const size_t count = geometry.first[path + 1] - first;
  for (size_t m = 0; m < count; ++m) {
    const VertexPlace place = interactions_.place(geometry, first + m);
    paths.vertex_position_m[first_vertex + m] = geometry.vertex[first + m] + origin_m_;
    paths.vertex_interaction[first_vertex + m] = geometry.interaction[first + m];
    paths.vertex_surface[first_vertex + m] = place.number;
    paths.vertex_instance[first_vertex + m] = place.instance;
  }
  const SphericalBasis departure_basis = basis_of(departure), arrival_basis = basis_of(arrival);
  const Matrix2 m = interactions_.carried(geometry, path, state, legs, departure_basis, arrival_basis, sibling);

  const Angles aod = angles_of(departure), aoa = angles_of(arrival);
  paths.tx[row] = geometry.tx[path];
  paths.rx[row] = geometry.rx[path];
  paths.depth[row] = static_cast<uint32_t>(count);
  paths.delay_s[row] = legs.length_m() / speed_of_light_m_s;
  paths.aod_theta_rad[row] = aod.theta_rad;
  paths.aod_phi_rad[row] = aod.phi_rad;
  paths.aoa_theta_rad[row] = aoa.theta_rad;
  paths.aoa_phi_rad[row] = aoa.phi_rad;
  // Plus zero: where all stands still the shift is 0, not -0.
  const double wavelength_m = interactions_.wavelength_m();
  const std::span instances(paths.vertex_instance.data() + first_vertex, count);
  paths.doppler_hz[row] = closing_speed_m_s(legs, state, geometry, path, instances) / wavelength_m + 0.0;
  const PortFields sent = tx.fields(departure, departure_basis, state.transmitters[geometry.tx[path]].rotation);
  const PortFields heard = rx.fields(arrival, arrival_basis, state.receivers[geometry.rx[path]].rotation);
  const double at_1_m = wavelength_m / (4 * std::numbers::pi);
  double power = 0;
  for (uint32_t t = 0; t < tx.ports(); ++t) {
    const FieldPair come{m[0] * sent[t].theta + m[1] * sent[t].phi, m[2] * sent[t].theta + m[3] * sent[t].phi};
    for (uint32_t r = 0; r < rx.ports(); ++r) {
      std::complex<double>& a = paths.a[row][r * tx_ports_ + t];
      a = at_1_m * (heard[r].theta * come.theta + heard[r].phi * come.phi);
      power += std::norm(a);
    }
  }
  paths.gain_db[row] = 10 * std::log10(power);
}

Paths FieldModel::compute(uint32_t frame, PathGeometry found, const WorldState& state, LeftOut* left_out) const {
  LeftOut near;
  const PathGeometry geometry = without_near_ends(std::move(found), interactions_.surfaces(), state, near);
  if (left_out) *left_out = std::move(near);
  std::vector<double> delay_s(geometry.size());
  tbb::parallel_for(size_t{0}, geometry.size(),
                    [&](size_t path) { delay_s[path] = path_length_m(state, geometry, path) / speed_of_light_m_s; });
  const std::vector<uint32_t> order = ordered(geometry, delay_s);

  Paths paths;
  paths.rx_ports = rx_ports_;
  paths.tx_ports = tx_ports_;
  resize(paths, geometry.size(), geometry.vertex.size());
  std::ranges::fill(paths.frame, frame);
  if (!geometry.quarters.empty())
    for (const uint32_t path : order) paths.quarters.push_back(geometry.quarters[path]);
  for (size_t row = 0; row < order.size(); ++row)
    paths.vertex_offset[row + 1] =
        paths.vertex_offset[row] + geometry.first[order[row] + 1] - geometry.first[order[row]];
  tbb::parallel_for(tbb::blocked_range<size_t>(0, geometry.size(), 64), [&](const tbb::blocked_range<size_t>& rows) {
    Legs legs;
    for (size_t row = rows.begin(); row < rows.end(); ++row) {
      legs.fill(interactions_.surfaces(), state, geometry, order[row]);
      const auto sibling = [&](std::span<const uint32_t> surfaces, std::span<const uint8_t> interactions) {
        return has_sibling(geometry, delay_s, order, row, surfaces, interactions);
      };
      evaluate(geometry, order[row], state, legs, sibling, paths, row);
    }
  });
  return paths;
}

Paths compute_paths(const Scene& scene, const Config& config, uint32_t frame, const PathGeometry& geometry) {
  return FieldModel(scene, config).compute(frame, geometry);
}

}  // namespace wavetracer
