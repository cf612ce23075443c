// SPDX-License-Identifier: Apache-2.0
// With c for the rest, look-ups take u = c + uniform, m = c + Morton and x = c + uniform + Morton. So the uniform hash
// takes x - m, the one of Morton codes x - u, and c is u + m - x. The heads of the chained table lie in a processor's
// cache, so that c hardly depends on where a hash leads.
#include "study/lookup_parts.hpp"
#include <cmath>

namespace wavetracer::study {
namespace {

Measured empty_lookup(const CacheRows& rows, const std::string& setting) {
  for (const CacheRow& row : rows)
    if (row.setting == setting && row.depth == 1 && row.region == 0 && row.rays == rows.front().rays &&
        row.drive == rows.front().drive)
      return measured_empty_lookup_ns(row);
  return {};
}

struct Term {
  double factor;
  Measured value;
};

// A difference keeps the noise of its terms, as margins are relative to a value.
Measured sum_of(const std::vector<Term>& terms) {
  Measured out{0, 0};
  for (const Term& term : terms) {
    out.value += term.factor * term.value.value;
    out.error = std::hypot(out.error, term.factor * margin(term.value) / noise_factor);
  }
  return out;
}

// Returns the method by which the name of a setting ends; 0 for others.
uint32_t hash_method_of(const std::string& setting) {
  for (const uint32_t method : {1u, 2u, 3u})
    if (setting.ends_with(" " + hash_name(method))) return method;
  return 0;
}

}  // namespace

LookupParts lookup_parts(const CacheRows& rows, const std::string& setting) {
  const uint32_t method = hash_method_of(setting);
  if (rows.empty() || method == 0) return {};
  const std::string table = setting.starts_with("printed ") ? "printed chained " : "chained ";
  const Measured uniform = empty_lookup(rows, table + hash_name(1)), morton = empty_lookup(rows, table + hash_name(2)),
                 mixed = empty_lookup(rows, table + hash_name(3));
  if (setting == table + hash_name(method))
    return {method == 1   ? sum_of({{1, mixed}, {-1, morton}})
            : method == 2 ? sum_of({{1, mixed}, {-1, uniform}})
                          : sum_of({{2, mixed}, {-1, uniform}, {-1, morton}}),
            sum_of({{1, uniform}, {1, morton}, {-1, mixed}})};
  const Measured hash = lookup_parts(rows, table + hash_name(method)).hash;
  return {hash, sum_of({{1, empty_lookup(rows, setting)}, {-1, hash}})};
}

Judge<CacheRow> buffer_calls_are_short(std::vector<std::string> settings) {
  return [=](const CacheRows& rows) {
    Cases out{.form = ratio_form("a call of the buffer", "a write")};
    for (const std::string& setting : settings) {
      const CacheRow* row = find_cached(rows, setting, rows.front().rays, rows.front().drive);
      if (!row) continue;
      const Measured call = lookup_parts(rows, setting).buffer_call, write = measured_write_ns(*row);
      Answer answer = less(call, 0.1 * write);
      const Measured without_ray = sum_of({{1, call}, {-1, measured_gather_ns(*row)}});
      if (answer == Answer::no && less(0.1 * write, without_ray) != Answer::yes) answer = Answer::undecided;
      out.all.push_back({'"' + setting + '"', 0, answer, call.value / write.value});
    }
    return out;
  };
}

}  // namespace wavetracer::study
