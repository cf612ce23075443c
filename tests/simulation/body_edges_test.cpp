// SPDX-License-Identifier: Apache-2.0
// Bodies behind an edge: each path is the product of the way over the edge, the matrix of its piece and the way on; and
// the wave of a piece bends about the edge, so that large pieces have the field of small ones.
#include <map>

#include "radio/target_pieces.hpp"
#include "simulation/body_world.hpp"
#include "wavetracer/device/facet.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using device::wt_basis;

// A wall whose upper edge is between the antennas and the body.
const std::vector<Quad> wall{{{6, -40, -20}, {0.3, 80, 1}, {0.1, 0, 30.3}}};
const glm::dvec3 antenna_a = body_place + glm::dvec3(11, 1.2, -0.6),
                 antenna_b = body_place + glm::dvec3(4.5, -0.5, -0.6);

Config edge_world(const SceneFile& scene, const SceneFile& body, double piece_m) {
  Config config = body_world(scene, body, {antenna_a}, {antenna_b}, 3, true);
  config.trace.diffraction = true;
  config.trace.target_reflections = 1;
  config.trace.target_diffraction = true;
  config.target_models[0].piece_m = piece_m;
  return config;
}

// Paths from the sender over the edge to a piece, and straight on to the receiver.
std::vector<size_t> bent(const Paths& paths) {
  std::vector<size_t> out;
  for (const size_t i : echoes(paths)) {
    const uint64_t first = paths.vertex_offset[i];
    if (paths.depth[i] == 2 && paths.vertex_interaction[first] == diffraction) out.push_back(i);
  }
  return out;
}

Channel sum_of_bent(const Paths& paths) {
  Channel out{};
  for (const size_t i : bent(paths))
    for (size_t k = 0; k < 4; ++k)
      out[k] += paths.a[i][k] * std::polar(1.0, -2 * std::numbers::pi * body_hz * paths.delay_s[i]);
  return out;
}

Channel times(const Channel& to, const Channel& from) {
  return {to[0] * from[0] + to[1] * from[2], to[0] * from[1] + to[1] * from[3], to[2] * from[0] + to[3] * from[2],
          to[2] * from[1] + to[3] * from[3]};
}

// The matrix of a small conducting facet from the field along `from` to that along `to`, in metres.
Channel facet_matrix(const glm::dvec3& k_in, const glm::dvec3& k_out, const glm::dvec3& normal, double area_m2,
                     const wt_basis& from, const wt_basis& to) {
  const auto one_way = [&](const glm::dvec3& in, const glm::dvec3& out, const wt_basis& sent, const wt_basis& heard) {
    const wt_basis met = device::wt_polarizations(in, normal);
    const device::wt_matrix m = device::wt_facet_matrix(in, out, normal, {-1, 0}, {1, 0}, heard);
    const Channel facet{std::complex(m.m[0].x, m.m[0].y), std::complex(m.m[1].x, m.m[1].y),
                        std::complex(m.m[2].x, m.m[2].y), std::complex(m.m[3].x, m.m[3].y)};
    return times(facet, {glm::dot(met.first, sent.first), glm::dot(met.first, sent.second),
                         glm::dot(met.second, sent.first), glm::dot(met.second, sent.second)});
  };
  const Channel there = one_way(k_in, k_out, from, to), back = one_way(-k_out, -k_in, to, from);
  const std::complex<double> scale = std::complex(0.0, 0.5 / body_wave_m) * area_m2 * 0.5;
  return {(there[0] + back[0]) * scale, (there[1] + back[2]) * scale, (there[2] + back[1]) * scale,
          (there[3] + back[3]) * scale};
}

}  // namespace

TEST_CASE("a path over an edge and a piece is the product of the way over the edge, the piece, and the way on") {
  const SceneFile scene(wall), plate(one_plate);
  Simulation simulation(edge_world(scene, plate, 0.02));
  const auto pieces = pieces_of_body(simulation.models().front(), 0.02, "plate");
  const Paths paths = simulation.run_frame(0).paths;
  const std::vector<size_t> rows = bent(paths);
  REQUIRE(rows.size() > 100);
  double largest = 0;
  for (const size_t i : rows) largest = std::max(largest, std::abs(paths.a[i][0]));
  for (size_t n = 0; n < rows.size(); n += rows.size() / 7) {
    const size_t i = rows[n];
    const uint64_t at = paths.vertex_offset[i];
    const TargetPiece& piece = pieces[paths.vertex_surface[at + 1]];
    const glm::dvec3 edge = paths.vertex_position_m[at], place = paths.vertex_position_m[at + 1];
    const auto way = [&](const glm::dvec3& from, const glm::dvec3& to, uint32_t depth) -> Channel {  // by this edge
      Config config = radar_world(scene, {from}, {to}, 1);
      config.radio.frequency_hz = body_hz;
      config.trace.diffraction = true;
      const Paths found = run(config).paths;
      for (size_t k = 0; k < found.size(); ++k)
        if (found.depth[k] == depth &&
            (depth == 0 || glm::distance(found.vertex_position_m[found.vertex_offset[k]], edge) < 1e-6))
          return {found.a[k][0], found.a[k][1], found.a[k][2], found.a[k][3]};
      FAIL("there is no such way");
      return {};
    };
    const glm::dvec3 k_in = glm::normalize(place - edge), k_out = glm::normalize(antenna_b - place);
    const auto corner = [&](int k) {
      return glm::dvec3(piece.facet.corners[3 * k], piece.facet.corners[3 * k + 1], piece.facet.corners[3 * k + 2]);
    };
    const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    glm::dvec3 lit = glm::normalize(across);
    if (glm::dot(lit, k_in) > 0) lit = -lit;
    const Channel matrix = facet_matrix(k_in, k_out, lit, 0.5 * glm::length(across), device::wt_spherical_basis(-k_in),
                                        device::wt_spherical_basis(k_out));
    Channel expected = times(way(place, antenna_b, 0), times(matrix, way(antenna_a, place, 1)));
    for (auto& value : expected) value *= 4 * std::numbers::pi / body_wave_m;
    CAPTURE(n);
    // The phase over a piece of 0.02 m is not constant: it lowers the field by some per cent.
    for (size_t k = 0; k < 4; ++k) CHECK(std::abs(paths.a[i][k] - expected[k]) < 0.06 * largest);
  }
}

TEST_CASE("behind an edge, large pieces have the field of small ones, and each path is reciprocal") {
  const SceneFile scene(wall), plate(one_plate);
  const Paths small = run(edge_world(scene, plate, 0.02)).paths;
  const Channel fine = sum_of_bent(small);
  const Paths large = run(edge_world(scene, plate, 0.2)).paths;
  CHECK(10 * bent(large).size() < bent(small).size());
  MESSAGE(fmt::format("pieces of 0.2 m are off by {:.4f} from those of 0.02 m", difference(sum_of_bent(large), fine)));
  CHECK(difference(sum_of_bent(large), fine) < 0.03);
  Config turned = edge_world(scene, plate, 0.2);
  std::swap(turned.transmitters[0].position_m, turned.receivers[0].position_m);
  const Paths back = run(turned).paths;
  REQUIRE(back.size() == large.size());
  double largest = 0;
  for (const size_t i : bent(large)) largest = std::max(largest, std::abs(large.a[i][0]));
  for (const size_t i : bent(large)) {
    const auto same = std::ranges::min_element(back.delay_s, {},
                                               [&](double delay_s) { return std::abs(delay_s - large.delay_s[i]); });
    const auto j = static_cast<size_t>(same - back.delay_s.begin());
    for (const auto& [p, q] : {std::pair{0, 0}, {1, 2}, {2, 1}, {3, 3}})
      CHECK(std::abs(large.a[i][p] - back.a[j][q]) < 1e-7 * largest);
  }
}
