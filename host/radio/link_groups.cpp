// SPDX-License-Identifier: Apache-2.0
// Rows grouped by link: two stable counting sorts, by receiver and then by transmitter.
// The time is linear, and so short that one core suffices.
#include "radio/link_groups.hpp"

#include <algorithm>
#include <numeric>

namespace wavetracer {
namespace {

// Returns the rows in the order of their keys, stable.
std::vector<uint32_t> counting_sort(const std::vector<uint32_t>& rows, std::span<const uint32_t> key) {
  std::vector<uint32_t> next(key.empty() ? 1 : std::ranges::max(key) + size_t{2}, 0);
  for (const uint32_t k : key) ++next[k + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<uint32_t> sorted(rows.size());
  for (const uint32_t row : rows) sorted[next[key[row]]++] = row;
  return sorted;
}

}  // namespace

LinkGroups group_by_link(std::span<const uint32_t> tx, std::span<const uint32_t> rx) {
  LinkGroups groups;
  groups.row.resize(tx.size());
  std::iota(groups.row.begin(), groups.row.end(), 0u);
  groups.row = counting_sort(counting_sort(groups.row, rx), tx);
  for (uint32_t i = 1; i < groups.row.size(); ++i) {
    const uint32_t before = groups.row[i - 1], row = groups.row[i];
    if (tx[row] != tx[before] || rx[row] != rx[before]) groups.first.push_back(i);
  }
  if (!groups.row.empty()) groups.first.push_back(static_cast<uint32_t>(groups.row.size()));
  return groups;
}

}  // namespace wavetracer
