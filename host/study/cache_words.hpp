// Phrases about rows of a study of caching, and the findings that its figures share.
// Percentages have no decimals, or one below ten; whoever compares them with the table rounds likewise.
#pragma once
#include <functional>
#include <string>
#include <vector>
#include "study/cache_rows.hpp"
#include "study/line_plot.hpp"
#include "study/run.hpp"

namespace wavetracer::study {

// "12% less time", "3.0% more time", "the same time" within half a percent.
std::string saved_words(double percent);
// A share as "2.5%", "0.031%" or "none".
std::string share_words(double share);
// "confirmed" or "not confirmed".
std::string verdict(bool holds);

// "at every number of rays", "at none", "at 1,000 and 64,000 rays": where it holds, of the rays that were measured.
using AtRays = std::function<bool(uint64_t rays)>;
std::string where_words(const std::vector<uint64_t>& rays, const AtRays& holds);

// Time saved and errors at the most rays, a row a drive and setting but the first, the fastest first.
NumberTable summary_table(const std::vector<CacheRow>& rows);

// "fixed transmitter", ..., and a phrase for each: "fixed transmitter: ... . moving transmitter: ...".
std::string drive_words(const std::string& drive);
std::string each_drive(const std::vector<CacheRow>& rows, const std::function<std::string(const std::string&)>& words);

// " and" for the last: a sentence's list.
std::string list_words(const std::vector<std::string>& words);

// Words without numbers get the summary table. `plot` needs neither name nor title. Without columns of its own it draws
// the table of all columns, which is then the findings'; otherwise the caller sets the table.
Findings cache_findings(const Recipe& recipe, const CacheMeasurement& measured, const Request& request, Words words,
                        LinePlot plot, const std::string& caption);
// A panel for every drive in which its column has a value, with the drive in its title where there are several.
std::vector<LinePanel> panels_of(const std::vector<CacheRow>& rows, const std::vector<LinePanel>& a_drive);
// How it was measured.
std::vector<std::string> study_notes(const CacheMeasurement& measured, const Request& request);

}  // namespace wavetracer::study
