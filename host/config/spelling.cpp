// Edit distance over three rows, and the choice of the nearest word.
// It assumes that the known words are short: the cost is the product of lengths that are near each other.
#include "config/spelling.hpp"
#include <algorithm>
#include <array>

namespace wavetracer::config {

size_t edit_distance(std::string_view a, std::string_view b) {
  std::array<std::vector<size_t>, 3> rows;  // rows i - 2, i - 1 and i of the table
  for (auto& row : rows) row.resize(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) rows[1][j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    rows[2][0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = rows[1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      size_t best = std::min({rows[1][j] + 1, rows[2][j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) best = std::min(best, rows[0][j - 2] + 1);
      rows[2][j] = best;
    }
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1][b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  const bool plain = word.find('.') == std::string_view::npos;
  // A third of the word may be wrong, at least one letter: beyond that a hint misleads.
  size_t best = std::max<size_t>(1, word.size() / 3) + 1;
  std::string found;
  // Letters that one has more are letters that differ: a word too long or short is not compared, so a key of megabytes
  // costs nothing.
  const auto distance_to = [&](std::string_view text) {
    const size_t longer = std::max(word.size(), text.size()), shorter = std::min(word.size(), text.size());
    return longer - shorter < best ? edit_distance(word, text) : best;
  };
  for (const std::string& candidate : known) {
    size_t distance = distance_to(candidate);
    const size_t dot = candidate.rfind('.');
    if (plain && dot != std::string::npos)
      distance = std::min(distance, distance_to(std::string_view(candidate).substr(dot + 1)));
    if (distance < best) {
      best = distance;
      found = candidate;
    }
  }
  return found;
}

std::string hint(std::string_view word, const std::vector<std::string>& known) {
  const std::string found = nearest(word, known);
  return found.empty() ? "" : "; did you mean \"" + found + "\"?";
}

}  // namespace wavetracer::config
