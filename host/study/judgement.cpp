// SPDX-License-Identifier: Apache-2.0
// Turns cases into an outcome.
// One case that holds and one that does not make "in part", whatever the others are.
#include "study/judgement.hpp"
#include <array>
#include "study/text.hpp"

namespace wavetracer::study {

std::string_view word(ClaimOutcome outcome) {
  static constexpr std::array words = {"not judged", "refuted", "in part", "reproduced", "exceeded"};
  return words.at(static_cast<size_t>(outcome));
}

std::ostream& operator<<(std::ostream& out, const Judgement& judgement) {
  return out << word(judgement.outcome) << ": " << judgement.words;
}

void Tally::add(bool holds, bool goes_beyond) {
  ++(holds ? held_ : failed_);
  if (holds && goes_beyond) ++beyond_;
}

void Tally::add(ClaimOutcome outcome) {
  if (outcome == ClaimOutcome::in_part) in_part_ = true;
  if (outcome == ClaimOutcome::in_part || outcome == ClaimOutcome::not_judged) return;
  add(outcome != ClaimOutcome::refuted, outcome == ClaimOutcome::exceeded);
}

ClaimOutcome Tally::outcome() const {
  if (in_part_ || (held_ > 0 && failed_ > 0)) return ClaimOutcome::in_part;
  if (failed_ > 0) return ClaimOutcome::refuted;
  if (held_ == 0) return ClaimOutcome::not_judged;
  return beyond_ == held_ ? ClaimOutcome::exceeded : ClaimOutcome::reproduced;
}

Judgement not_measured() { return {ClaimOutcome::not_judged, "not measured"}; }

Judgement judgement(bool holds) { return judgement(holds, verdict(holds)); }

Judgement judgement(bool holds, std::string words) {
  return {holds ? ClaimOutcome::reproduced : ClaimOutcome::refuted, std::move(words)};
}

}  // namespace wavetracer::study
