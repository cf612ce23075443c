// SPDX-License-Identifier: Apache-2.0
// The words of an experiment about its measurement: sentences, a verdict on each claim, and the numbers behind them.
// The report, the terminal and the thesis' page show the same. Numbers are rounded here; comparisons with the table of
// an experiment must round in the same way.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>
#include "study/judgement.hpp"

namespace wavetracer::study {

// The author of a claim. Each is counted apart.
enum class Origin {
  thesis,     // A. Zhdanov
  other,      // another author, whom the claim names
  repetition  // a claim of another figure, or the same about other tables, such as those as printed
};
// Returns "thesis", "other author" or "repetition".
std::string_view word(Origin origin);

struct Verdict {
  std::string claim;
  ClaimOutcome outcome;
  std::string measured;
  Origin origin = Origin::thesis;
};

struct NumberTable {
  std::string caption;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;  // as many cells as heads
};

struct Words {
  std::string paragraph;
  std::vector<Verdict> verdicts = {};
  NumberTable numbers = {};
};

NumberTable verdict_table(const std::vector<Verdict>& verdicts);

// Returns the table in Markdown with aligned columns, so that its source can be read.
std::string markdown(const NumberTable& table);
// Returns the paragraph, the verdicts and the numbers, without a final line end.
std::string words_text(const Words& words);

// The texts that replace {NAME}.
using Fields = std::map<std::string, std::string>;
// Throws std::runtime_error for a name that has no field.
std::string filled(const std::string& text, const Fields& fields);

// Returns "12.3", "1230", "0.0012", "less than 0.001": never an exponent. digits: number of significant digits.
std::string plain(double value, int digits = 3);
// Returns a share as "2.5%", "0.031%" or "none".
std::string share_words(double share);
// Returns "12% less time", "3.0% more time", or "the same time" within half a percent.
std::string saved_words(double percent);
// Returns "a, b and c".
std::string list_words(const std::vector<std::string>& words);

}  // namespace wavetracer::study
