// SPDX-License-Identifier: Apache-2.0
// From answers to a verdict. A claim has cases: numbers of rays, or depths, in each world or setting. Each case has an
// answer, and outcome_of() turns the shares of the answers into the verdict.
#pragma once
#include <cstdint>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include "study/measured.hpp"

namespace wavetracer::study {

enum class ClaimOutcome {
  not_judged,    // no measurement of this program can decide the claim
  not_measured,  // the claim is about numbers of rays that were not measured
  undecided,     // the noise leaves half of the cases open, or more
  refuted,       // it holds in none of the decided cases
  in_part,       // it holds in some of the decided cases
  reproduced,    // it holds in every decided case
  exceeded       // it holds, and every decided case exceeds the claimed number by a tenth of it at least
};

// Returns "not judged", "not measured there", "undecided", "refuted", "in part", "reproduced" or "exceeded".
std::string_view word(ClaimOutcome outcome);
// Returns all of them, in the order of tables: from exceeded to not judged.
std::span<const ClaimOutcome> outcomes();

// The numbers of rays that the words of a claim are about, with both ends.
struct Range {
  static constexpr uint64_t open = std::numeric_limits<uint64_t>::max();
  uint64_t first = 0, last = open;

  bool contains(uint64_t rays) const { return first <= rays && rays <= last; }
  // Tells whether measured numbers of rays can speak for the range: one is in it, and, if the range has an end, one in
  // it is a quarter of the end at least. So nothing "up to 50,000,000 rays" is judged from 2,000.
  bool is_covered(const std::vector<uint64_t>& measured) const;
};
constexpr Range up_to(uint64_t last) { return {0, last}; }
constexpr Range beyond(uint64_t rays) { return {rays + 1, Range::open}; }
constexpr Range at_rays(uint64_t rays) { return {rays, rays}; }

// The answer for one case.
struct CaseAnswer {
  std::string group = {};  // the world, the setting, whether the sort is paid; may be empty
  uint64_t at = 0;         // the number of rays, or the depth; 0: the finding is about all of them
  Answer answer = Answer::absent;
  double value = undefined;  // the measured number
  std::string note = {};     // stands for the value
};

// The way in which values are written: "a factor of 1.20", "7.90 m".
struct ValueForm {
  std::string before = {};
  std::string (*text)(double) = nullptr;  // null: values are not written
  std::string after = {};
};
ValueForm factor_form();
// For a value of one thing over that of another: "no cache over precision 0.0125 Morton: 0.63".
ValueForm ratio_form(const std::string& of, const std::string& over);
ValueForm unit_form(const std::string& unit);
ValueForm time_form();         // for a time over that of no cache: "12% less time"
ValueForm correlation_form();  // two decimals
ValueForm share_form();

struct Cases {
  std::vector<CaseAnswer> all = {};
  ValueForm form = {};
  std::string at = "rays";  // "depth" for depths
  std::string why = {};     // not empty: no measurement can judge the claim, for this reason
};

// Most of the measured cases must be decided. Then the shares of those that hold count, see ClaimOutcome.
ClaimOutcome outcome_of(const Cases& cases);
// Returns a text for each group: "fixed transmitter: yes at 1,000 and 5,000 rays, no at 10,000 rays (1.0% more time to
// 12% less time)".
std::string words_of(const Cases& cases);

struct Judgement {
  ClaimOutcome outcome;
  std::string words;

  bool operator==(std::string_view text) const { return words == text; }
};
std::ostream& operator<<(std::ostream& out, const Judgement& judgement);

Judgement judgement_of(const Cases& cases);
// Returns the judgement of a claim whose range the measured numbers of rays do not cover.
Judgement not_measured_there(const std::vector<uint64_t>& measured);

}  // namespace wavetracer::study
