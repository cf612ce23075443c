// SPDX-License-Identifier: Apache-2.0
// The judgement of a claim: one of five outcomes, and words for what was measured.
#pragma once
#include <ostream>
#include <string>
#include <string_view>

namespace wavetracer::study {

enum class ClaimOutcome {
  not_judged,  // nothing was measured that could confirm or refute the claim
  refuted,     // it holds in no case
  in_part,     // it holds in some cases
  reproduced,  // it holds in every case
  exceeded     // it holds, and every case exceeds the claimed number by a tenth of it at least
};

// A claim is exceeded if a measured factor or share is beyond this times the claimed one.
constexpr double exceeding = 1.1;

// Returns "not judged", "refuted", "in part", "reproduced" or "exceeded".
std::string_view word(ClaimOutcome outcome);

struct Judgement {
  ClaimOutcome outcome;
  std::string words;

  bool operator==(std::string_view text) const { return words == text; }
};
std::ostream& operator<<(std::ostream& out, const Judgement& judgement);

// The cases of a claim: worlds, settings, numbers of rays, depths.
class Tally {
 public:
  void add(bool holds, bool goes_beyond = false);
  void add(ClaimOutcome outcome);
  ClaimOutcome outcome() const;

 private:
  int failed_ = 0, held_ = 0, beyond_ = 0;  // beyond_: part of held_
  bool in_part_ = false;
};

Judgement not_measured();
// Returns "confirmed" and reproduced, or "not confirmed" and refuted; `words` replace these.
Judgement judgement(bool holds);
Judgement judgement(bool holds, std::string words);

}  // namespace wavetracer::study
