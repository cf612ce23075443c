// SPDX-License-Identifier: Apache-2.0
// Propagation paths of one or more frames: one row per path, vertices in a compressed row layout.
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer {

// The interaction of a wave at a vertex of its path, with the numbers in files; see also interaction_kinds.hpp.
enum Interaction : uint8_t { reflection = 1, scattering = 2, transmission = 4, diffraction = 8, target_point = 16 };

constexpr uint32_t no_instance = 0xFFFFFFFFu;
constexpr uint32_t no_target = 0xFFFFFFFFu;

// Groups of paths that form one wave: fields within a group are added with their phases, then the powers of groups are
// added. A diffracted wave near a shadow boundary belongs to the wave that ends there, with a weight that falls with
// the distance from the boundary. The power of a link is the sum over its groups g and pairs of ports of |sum over
// paths i of w_ig a_i exp(-j 2 pi f tau_i)|^2, with the weights w; squares of the weights of a path add up to 1.
constexpr size_t most_groups = 4;  // largest number of groups of a path
constexpr uint32_t no_group = 0xFFFFFFFFu;
// Numbers within the link, 0, 1, 2 ... in the order of its rows; the one with the largest weight comes first, and the
// last ones may be no_group with weight 0.
using GroupNumbers = std::array<uint32_t, most_groups>;
using GroupWeights = std::array<double, most_groups>;
constexpr GroupNumbers only_group(uint32_t number) { return {number, no_group, no_group, no_group}; }
constexpr GroupWeights whole_weight{1, 0, 0, 0};

// Row i of every array in Paths is one path; rows are sorted by frame, tx, rx, delay, then by sequence.
// a[i] is row major (rx port, tx port); single-port antennas use element 0 only.
// a is the passband coefficient between the antenna ports without the carrier phase of the delay:
// h(f) = sum a exp(-j 2 pi f tau). Angles are those of the global frame: theta from +z, phi from +x towards +y.
struct Paths {
  uint32_t rx_ports = 1, tx_ports = 1;  // 2 if any antenna of that side has two ports
  std::vector<uint32_t> frame, tx, rx, depth;
  std::vector<double> delay_s, gain_db;
  std::vector<std::array<std::complex<double>, 4>> a;
  std::vector<double> aod_theta_rad, aod_phi_rad, aoa_theta_rad, aoa_phi_rad, doppler_hz;
  // The quarters of the launch that found the path, one bit each (missed.hpp); empty if unknown. A path that needs no
  // ray has all four.
  std::vector<uint8_t> quarters;
  // The groups of each path and its weight in them, see above; empty: every path is a group of its own.
  std::vector<GroupNumbers> group;
  std::vector<GroupWeights> group_weight;
  // With output.lifetimes, else empty: both ends of the path, and all points of all vehicles, may be anywhere within
  // this distance of their places, and the path is still there. It is a lower bound, 100 m at most, and 0 where none is
  // known.
  std::vector<double> lifetime_m;
  // The target that the path goes by, a number of World::targets, or no_target; empty where there are no targets.
  std::vector<uint32_t> target;
  std::vector<uint64_t> vertex_offset{0};  // size() + 1 entries
  // One entry per interaction, ends excluded, in order from the transmitter.
  std::vector<glm::dvec3> vertex_position_m;  // file coordinates
  std::vector<uint8_t> vertex_interaction;
  // Index in its scene or model; for a diffraction the wedge (`scene info --edges`), for a target its point.
  std::vector<uint32_t> vertex_surface;
  std::vector<uint32_t> vertex_instance;

  size_t size() const { return delay_s.size(); }
};

}  // namespace wavetracer
