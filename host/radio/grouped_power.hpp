// SPDX-License-Identifier: Apache-2.0
// The power of a link: fields of one group are added with their phases, then powers of groups (wavetracer/paths.hpp).
#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "wavetracer/paths.hpp"

namespace wavetracer {

// Sums the fields of each group of a link; a field is `values` numbers, for instance one for each pair of ports.
class GroupFields {
 public:
  // Rows first to end - 1 are those of one link and frame.
  GroupFields(const Paths& paths, size_t first, size_t end, size_t values);

  // Is the path a whole group? Its power is its own, and it need not be added.
  bool is_alone(size_t row) const;
  // fields: those of the path, with the phase of its delay.
  void add(size_t row, std::span<const std::complex<double>> fields);
  // Adds the powers of the fields that add() got: each of powers is a sum over values / powers.size() values in a row.
  void add_powers(std::span<double> powers) const;

 private:
  const Paths& paths_;
  size_t values_;
  std::vector<uint32_t> members_;           // for each group
  std::vector<std::complex<double>> sums_;  // (group, value)
};

// The power relative to the transmitted power, summed over pairs of ports; without groups each path is a group. Rows as
// above.
double grouped_power(const Paths& paths, size_t first, size_t end, double frequency_hz);

}  // namespace wavetracer
