// SPDX-License-Identifier: Apache-2.0
// Most paths are whole groups: their powers need no phase, and keep all their bits.
#include "radio/grouped_power.hpp"

#include <algorithm>

#include "radio/path_power.hpp"

namespace wavetracer {

GroupFields::GroupFields(const Paths& paths, size_t first, size_t end, size_t values) : paths_(paths), values_(values) {
  if (paths.group.empty()) return;
  for (size_t row = first; row < end; ++row)
    for (const uint32_t group : paths.group[row]) {
      if (group == no_group) continue;
      if (group >= members_.size()) members_.resize(size_t{group} + 1);
      ++members_[group];
    }
}

bool GroupFields::is_alone(size_t row) const {
  if (paths_.group.empty()) return true;
  const GroupNumbers& group = paths_.group[row];
  return group[1] == no_group && (group[0] == no_group || members_[group[0]] == 1);
}

void GroupFields::add(size_t row, std::span<const std::complex<double>> fields) {
  sums_.resize(members_.size() * values_);
  const GroupNumbers& group = paths_.group[row];
  for (size_t i = 0; i < most_groups && group[i] != no_group; ++i)
    for (size_t k = 0; k < values_; ++k) sums_[group[i] * values_ + k] += paths_.group_weight[row][i] * fields[k];
}

void GroupFields::add_powers(std::span<double> powers) const {
  const size_t each = values_ / powers.size();
  for (size_t i = 0; i < sums_.size(); ++i) powers[i % values_ / each] += std::norm(sums_[i]);
}

double grouped_power(const Paths& paths, size_t first, size_t end, double frequency_hz) {
  GroupFields groups(paths, first, end, paths.a.empty() ? 1 : paths.a[0].size());
  double power = 0;
  for (size_t row = first; row < end; ++row) {
    if (groups.is_alone(row)) {
      power += power_of(paths, row);
      continue;
    }
    auto fields = paths.a[row];
    for (auto& a : fields) a *= carrier_phase(frequency_hz, paths.delay_s[row]);
    groups.add(row, fields);
  }
  groups.add_powers({&power, 1});
  return power;
}

}  // namespace wavetracer
