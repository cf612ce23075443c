// SPDX-License-Identifier: Apache-2.0
// Computes edit distances with three rows of the table, and chooses the nearest word.
// Most words differ in too many letters and need no table; a table is given up at the first row that exceeds the limit.
#include "base/spelling.hpp"
#include <algorithm>
#include <array>

namespace wavetracer {
namespace {

// A lower bound of the distance: letters that only one of the words has must be inserted, deleted or substituted,
// whatever their order.
size_t least_distance(std::string_view a, std::string_view b) {
  std::array<int, 256> left{};  // number of times that each letter is still unmatched
  for (const char c : a) ++left[static_cast<unsigned char>(c)];
  size_t shared = 0;
  for (const char c : b)
    if (left[static_cast<unsigned char>(c)]-- > 0) ++shared;
  return std::max(a.size(), b.size()) - shared;
}

}  // namespace

size_t edit_distance(std::string_view a, std::string_view b, size_t limit) {
  const size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  if (longer - shorter >= limit || least_distance(a, b) >= limit) return limit;
  std::array<std::vector<size_t>, 3> rows;  // rows i - 2, i - 1 and i of the table
  for (auto& row : rows) row.resize(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) rows[1][j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    rows[2][0] = i;
    size_t least = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = rows[1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      size_t best = std::min({rows[1][j] + 1, rows[2][j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) best = std::min(best, rows[0][j - 2] + 1);
      rows[2][j] = best;
      least = std::min(least, best);
    }
    // A later row comes from this row, or, by a swap and one step more, from the row before it.
    if (least >= limit && *std::ranges::min_element(rows[1]) + 1 >= limit) return limit;
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return std::min(rows[1][b.size()], limit);
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  const bool plain = word.find('.') == std::string_view::npos;
  // Up to a third of the word may be wrong, but at least one letter: beyond that a hint would mislead.
  size_t best = std::max<size_t>(1, word.size() / 3) + 1;
  std::string found;
  for (const std::string& candidate : known) {
    size_t distance = edit_distance(word, candidate, best);
    const size_t dot = candidate.rfind('.');
    if (plain && dot != std::string::npos)
      distance = std::min(distance, edit_distance(word, std::string_view(candidate).substr(dot + 1), best));
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string spelling_hint(std::string_view word, const std::vector<std::string>& known) {
  const std::string found = nearest_word(word, known);
  return found.empty() ? "" : "; did you mean \"" + found + "\"?";
}

}  // namespace wavetracer
