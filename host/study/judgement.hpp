// What rows say of a claim: an outcome out of five, and the words for what was measured.
#pragma once
#include <ostream>
#include <string>
#include <string_view>

namespace wavetracer::study {

enum class ClaimOutcome {
  not_judged,  // nothing was measured that could speak for or against the claim
  refuted,     // it holds in no case
  in_part,     // it holds in some cases
  reproduced,  // it holds in every case
  exceeded     // it holds, and every case goes beyond the claimed number by a tenth of it at least
};

// What a measured factor or share is beyond, against the claimed one, for a claim to be exceeded.
constexpr double exceeding = 1.1;

// "not judged", "refuted", "in part", "reproduced", "exceeded"
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
  int failed_ = 0, held_ = 0, beyond_ = 0;  // beyond_: of those that held
  bool in_part_ = false;
};

Judgement not_measured();
// "confirmed" and reproduced, or "not confirmed" and refuted; `words` take the place of these.
Judgement judgement(bool holds);
Judgement judgement(bool holds, std::string words);

}  // namespace wavetracer::study
