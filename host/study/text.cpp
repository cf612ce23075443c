// SPDX-License-Identifier: Apache-2.0
// Writes tables as text. Cells must not contain line ends; a bar in a cell is escaped.
// Text is ASCII, so that bytes are columns.
#include "study/text.hpp"
#include <fmt/args.h>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace wavetracer::study {
namespace {

constexpr double least = 0.001;  // smallest value that is printed in full

std::string percent(double value) { return fmt::format("{:.{}f}%", value, std::abs(value) < 9.95 ? 1 : 0); }

std::string cell_text(const std::string& cell) {
  std::string out;
  for (const char c : cell) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string line(const std::vector<std::string>& cells, const std::vector<size_t>& widths) {
  std::string out = "|";
  for (size_t i = 0; i < cells.size(); ++i) out += fmt::format(" {:<{}} |", cell_text(cells[i]), widths[i]);
  return out + "\n";
}

}  // namespace

std::string_view word(Origin origin) {
  static constexpr std::array words = {"thesis", "other author", "repetition"};
  return words.at(static_cast<size_t>(origin));
}

NumberTable verdict_table(const std::vector<Verdict>& verdicts) {
  NumberTable out{.caption = "", .heads = {"claim", "verdict", "measured"}, .rows = {}};
  for (const Verdict& one : verdicts) out.rows.push_back({one.claim, std::string(word(one.outcome)), one.measured});
  return out;
}

std::string markdown(const NumberTable& table) {
  std::vector<size_t> widths;
  for (const std::string& head : table.heads) widths.push_back(std::max<size_t>(cell_text(head).size(), 3));
  for (const auto& row : table.rows)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], cell_text(row[i]).size());
  std::vector<std::string> rule;
  for (const size_t width : widths) rule.emplace_back(width, '-');
  std::string text = table.caption.empty() ? "" : table.caption + "\n\n";
  text += line(table.heads, widths) + line(rule, widths);
  for (const auto& row : table.rows) text += line(row, widths);
  text.pop_back();
  return text;
}

std::string words_text(const Words& words) {
  std::string text = words.paragraph;
  if (!words.verdicts.empty()) text += "\n\n" + markdown(verdict_table(words.verdicts));
  if (!words.numbers.rows.empty()) text += "\n\n" + markdown(words.numbers);
  return text;
}

std::string filled(const std::string& text, const Fields& fields) {
  fmt::dynamic_format_arg_store<fmt::format_context> store;
  for (const auto& [name, value] : fields) store.push_back(fmt::arg(name.c_str(), value));
  return fmt::vformat(text, store);
}

std::string plain(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "undefined" : value > 0 ? "infinite" : "-infinite";
  if (value == 0) return "0";
  if (std::abs(value) < least) return value > 0 ? "less than 0.001" : "-0.001 to 0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  return fmt::format("{:.{}f}", value, std::max(digits - before, 0));
}

std::string share_words(double share) {
  if (std::isnan(share)) return "an undefined share";
  if (share == 0) return "none";
  return 100 * share < 9.95 ? plain(100 * share, 2) + "%" : percent(100 * share);
}

std::string saved_words(double percentage) {
  if (std::abs(percentage) < 0.5) return "the same time";
  return percent(std::abs(percentage)) + (percentage > 0 ? " less time" : " more time");
}

std::string list_words(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

}  // namespace wavetracer::study
