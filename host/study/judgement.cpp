// SPDX-License-Identifier: Apache-2.0
// Counts answers, and writes them down.
// Long lists of numbers of rays are counted instead.
#include "study/judgement.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include "base/digits.hpp"
#include "study/text.hpp"

namespace wavetracer::study {
namespace {

constexpr size_t longest_list = 3;

// Returns " at 1,000 and 5,000 rays", " at all 9 numbers of rays", " at depth 1", or an empty text.
std::string places(const std::vector<uint64_t>& at, size_t of, const std::string& unit) {
  if (at.empty() || at.front() == 0) return "";
  std::vector<std::string> words;
  for (const uint64_t one : at) words.push_back(grouped(one));
  const bool rays = unit == "rays";
  const std::string plural = rays ? "numbers of rays" : unit + "s";
  if (at.size() == of && of > longest_list) return fmt::format(" at all {} {}", of, plural);
  if (at.size() > longest_list) return fmt::format(" at {} of {} {}", at.size(), of, plural);
  if (rays) return " at " + list_words(words) + " rays";
  return fmt::format(" at {}{} {}", unit, at.size() > 1 ? "s" : "", list_words(words));
}

// Returns "0.90 to 1.20 m", or what notes say, or "0.90 m; elsewhere both are 0".
std::string values_of(const std::vector<const CaseAnswer*>& cases, const ValueForm& form) {
  double low = undefined, high = undefined;
  std::string note;
  for (const CaseAnswer* one : cases) {
    if (!one->note.empty()) note = one->note;
    if (std::isnan(one->value)) continue;
    low = std::isnan(low) ? one->value : std::min(low, one->value);
    high = std::isnan(high) ? one->value : std::max(high, one->value);
  }
  if (!form.text || std::isnan(low)) return note;
  const std::string first = form.text(low), last = form.text(high);
  return form.before + (first == last ? first : first + " to " + last) + form.after +
         (note.empty() ? "" : "; elsewhere " + note);
}

std::string group_words(const std::vector<const CaseAnswer*>& cases, const Cases& of) {
  const size_t measured =
      std::ranges::count_if(cases, [](const CaseAnswer* one) { return one->answer != Answer::absent; });
  if (measured == 0) return cases.front()->note.empty() ? "not measured" : cases.front()->note;
  std::string text;
  for (const auto& [name, is] : {std::pair{"yes", Answer::yes}, {"no", Answer::no}, {"undecided", Answer::undecided}}) {
    std::vector<uint64_t> at;
    for (const CaseAnswer* one : cases)
      if (one->answer == is || (is == Answer::yes && one->answer == Answer::beyond)) at.push_back(one->at);
    if (!at.empty()) text += (text.empty() ? "" : ", ") + std::string(name) + places(at, measured, of.at);
  }
  const std::string values = values_of(cases, of.form);
  return values.empty() ? text : fmt::format("{} ({})", text, values);
}

std::string two_decimals(double value) { return fmt::format("{:.2f}", value + 0.0); }
std::string of_a_time(double share) { return saved_words(100 * (1 - share)); }
std::string three_digits(double value) { return plain(value); }

}  // namespace

std::string_view word(ClaimOutcome outcome) {
  static constexpr std::array words = {"not judged", "not measured there", "undecided", "refuted",
                                       "in part",    "reproduced",         "exceeded"};
  return words.at(static_cast<size_t>(outcome));
}

std::span<const ClaimOutcome> outcomes() {
  using enum ClaimOutcome;
  static constexpr std::array all = {exceeded, reproduced, in_part, refuted, undecided, not_measured, not_judged};
  return all;
}

bool Range::is_covered(const std::vector<uint64_t>& measured) const {
  return std::ranges::any_of(measured,
                             [&](uint64_t rays) { return contains(rays) && (last == open || 4 * rays >= last); });
}

ValueForm factor_form() { return {"a factor of ", two_decimals, ""}; }
ValueForm ratio_form(const std::string& of, const std::string& over) {
  return {of + " over " + over + ": ", two_decimals, ""};
}
ValueForm unit_form(const std::string& unit) { return {"", three_digits, " " + unit}; }
ValueForm time_form() { return {"", of_a_time, ""}; }
ValueForm correlation_form() { return {"", two_decimals, ""}; }
ValueForm share_form() { return {"", share_words, ""}; }

ClaimOutcome outcome_of(const Cases& cases) {
  if (!cases.why.empty()) return ClaimOutcome::not_judged;
  size_t held = 0, beyond = 0, failed = 0, open = 0;
  for (const CaseAnswer& one : cases.all) {
    held += one.answer == Answer::yes || one.answer == Answer::beyond;
    beyond += one.answer == Answer::beyond;
    failed += one.answer == Answer::no;
    open += one.answer == Answer::undecided;
  }
  const size_t decided = held + failed;
  if (decided + open == 0) return ClaimOutcome::not_measured;
  if (decided <= open) return ClaimOutcome::undecided;
  if (held == 0) return ClaimOutcome::refuted;
  if (failed > 0) return ClaimOutcome::in_part;
  return beyond == held ? ClaimOutcome::exceeded : ClaimOutcome::reproduced;
}

std::string words_of(const Cases& cases) {
  if (!cases.why.empty()) return cases.why;
  std::vector<std::string> groups;
  for (const CaseAnswer& one : cases.all)
    if (std::ranges::find(groups, one.group) == groups.end()) groups.push_back(one.group);
  std::string text;
  for (const std::string& group : groups) {
    std::vector<const CaseAnswer*> members;
    for (const CaseAnswer& one : cases.all)
      if (one.group == group) members.push_back(&one);
    text += (text.empty() ? "" : "; ") + (group.empty() ? "" : group + ": ") + group_words(members, cases);
  }
  return text.empty() ? "not measured" : text;
}

std::ostream& operator<<(std::ostream& out, const Judgement& judgement) {
  return out << word(judgement.outcome) << ": " << judgement.words;
}

Judgement judgement_of(const Cases& cases) { return {outcome_of(cases), words_of(cases)}; }

Judgement not_measured_there(const std::vector<uint64_t>& measured) {
  if (measured.empty()) return {ClaimOutcome::not_measured, "nothing was measured"};
  const auto [least, most] = std::ranges::minmax(measured);
  return {ClaimOutcome::not_measured, least == most
                                          ? fmt::format("measured at {} rays", grouped(least))
                                          : fmt::format("measured from {} to {} rays", grouped(least), grouped(most))};
}

}  // namespace wavetracer::study
