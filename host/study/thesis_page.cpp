// SPDX-License-Identifier: Apache-2.0
// The page and its picture: strings only.
// Only the names in a row of the table may need escapes.
#include <fmt/format.h>
#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include "base/html_page.hpp"
#include "base/xml_text.hpp"
#include "study/ray_counts.hpp"
#include "study/thesis.hpp"

namespace wavetracer::study {
namespace {

// Returns for every study, drive and setting the row with the most rays, without the settings that have no cache and
// serve as references.
std::vector<CacheRow> best_known(const std::vector<CacheRow>& rows) {
  const auto key = [](const CacheRow& row) { return std::tie(row.study, row.drive, row.setting); };
  std::map<std::tuple<std::string, std::string, std::string>, uint64_t> most;
  for (const CacheRow& row : rows) most[key(row)] = std::max(most[key(row)], row.rays);
  std::vector<CacheRow> out;
  for (const CacheRow& row : rows)
    if (is_whole(row) && row.rays == most.at(key(row))) out.push_back(row);
  return out;
}

bool shown(const CacheRow& row) { return is_whole(row) && row.error.reference_paths > 0 && row.cache.on; }

// Returns the numbers of each cache at its most rays.
NumberTable speed_error_numbers(const std::vector<CacheRow>& rows) {
  NumberTable table{
      .caption = "",
      .heads = {"study", "world", "setting", "rays", "division", "position step", "time saved", "look-ups answered",
                "lost paths", "spurious paths", "lost power", "delay spread", "centroid L1", "centroid L2"},
      .rows = {}};
  for (const CacheRow& row : best_known(rows)) {
    if (!shown(row)) continue;
    const PathError& e = row.error;
    table.rows.push_back({row.study, row.drive, row.setting, grouped(row.rays), grouped(row.division),
                          fmt::format("{:g} m", row.position_step_m), fmt::format("{:.1f} %", row.saved_percent),
                          share_words(hit_rate(row)), share_words(e.lost_share), share_words(e.spurious_share),
                          e.lost_power > 0 ? fmt::format("{:.1f} dB", share_db(e.lost_power)) : "none",
                          plain(e.delay_spread_ns, 2) + " ns", share_words(e.l1_relative), share_words(e.l2_relative)});
  }
  return table;
}

struct FigureVerdict {
  std::string figure;
  Verdict verdict;
  bool is_claim = true;  // false: it stands for a figure without a claim or without a result
};

std::vector<FigureVerdict> figure_verdicts(const std::vector<Section>& figures) {
  std::vector<FigureVerdict> out;
  for (const Section& figure : figures) {
    for (const Verdict& verdict : figure.words.verdicts) out.push_back({figure.name, verdict});
    if (figure.words.paragraph.empty())
      out.push_back({figure.name, {figure.title, ClaimOutcome::not_measured, figure.problem}, false});
    else if (figure.words.verdicts.empty())
      out.push_back({figure.name,
                     {figure.title, ClaimOutcome::not_judged, "no claim to judge; the numbers are in its section"},
                     false});
  }
  return out;
}

// Lists every claim, and where the page has more about it.
std::string verdicts_html(const std::vector<Section>& figures) {
  std::string text = "<section id=\"verdicts\">\n<h2>Verdicts</h2>\n" + table_html(outcome_counts(figures)) +
                     "<table class=\"words\">\n<thead><tr><th>figure</th>"
                     "<th>claim</th><th>verdict</th><th>measured</th></tr></thead>\n<tbody>\n";
  for (const FigureVerdict& one : figure_verdicts(figures))
    text += fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td>{1}</tr>\n", one.figure, verdict_cells(one.verdict));
  return text +
         "</tbody>\n</table>\n<p><a href=\"#speed-error\">Speed against error of all caches</a></p>\n"
         "</section>\n";
}

}  // namespace

NumberTable verdicts_of(const std::vector<Section>& figures) {
  NumberTable table{.caption = "", .heads = {"figure", "claim", "origin", "verdict", "measured"}, .rows = {}};
  for (const auto& [figure, verdict, is_claim] : figure_verdicts(figures))
    table.rows.push_back({figure, verdict.claim, is_claim ? std::string(word(verdict.origin)) : "no claim",
                          std::string(word(verdict.outcome)), verdict.measured});
  return table;
}

NumberTable outcome_counts(const std::vector<Section>& figures) {
  NumberTable table{.caption =
                        "Claims by origin and verdict. A repetition is a claim of another figure, or the same "
                        "claim about other tables, such as those as printed.",
                    .heads = {"origin", "claims"},
                    .rows = {}};
  for (const ClaimOutcome outcome : outcomes()) table.heads.emplace_back(word(outcome));
  const std::vector<FigureVerdict> all = figure_verdicts(figures);
  for (const Origin origin : {Origin::thesis, Origin::other, Origin::repetition}) {
    const auto count = [&](const std::function<bool(ClaimOutcome)>& counts) {
      return std::to_string(std::ranges::count_if(all, [&](const FigureVerdict& one) {
        return one.is_claim && one.verdict.origin == origin && counts(one.verdict.outcome);
      }));
    };
    table.rows.push_back({std::string(word(origin)), count([](ClaimOutcome) { return true; })});
    for (const ClaimOutcome outcome : outcomes())
      table.rows.back().push_back(count([outcome](ClaimOutcome one) { return one == outcome; }));
  }
  return table;
}

std::string family(const std::string& setting) {
  std::string text = setting;
  for (const uint32_t hash : {1u, 2u, 3u}) {
    const std::string ending = " " + hash_name(hash);
    if (const size_t at = text.find(ending); at != std::string::npos) text.erase(at, ending.size());
  }
  return text;
}

plots::Figure speed_error_figure(const std::vector<CacheRow>& rows, const std::string& device) {
  std::vector<CacheRow> points;
  for (const CacheRow& row : rows)
    if (shown(row)) {
      points.push_back(row);
      points.back().setting = family(row.setting);
    }
  LinePlot plot;
  plot.name = "thesis";
  plot.title = "Speed against error of all caches, " + device;
  for (const CacheRow& row : points)
    if (std::find(plot.settings.begin(), plot.settings.end(), row.setting) == plot.settings.end())
      plot.settings.push_back(row.setting);
  plot.x = "saved_percent";
  plot.x_label = "time saved (%)";
  plot.points = true;
  plot.least_x = -100;
  // Rows without an error are drawn at the bottom of an axis.
  plot.panels = {{"lost power", "lost_power", "share", "", true, 1e-7},
                 {"lost paths", "lost_share", "share", "", true, 1e-5},
                 {"spurious paths", "spurious_share", "share", "", true, 1e-5},
                 {"delay spread", "delay_spread_ns", "ns", "", true, 1e-4},
                 {"centroid, L1, of the mean path", "l1_relative", "share", "", true, 1e-6},
                 {"centroid, L2, of the mean path", "l2_relative", "share", "", true, 1e-6}};
  return line_figure(plot, csv_of(cache_columns(), points));
}

std::string thesis_html(const ThesisPage& page) {
  std::string text =
      "<h1>Ray orders and ray caches: the thesis' figures, measured</h1>\n<p>The claims are those of A. Zhdanov, TU "
      "Munich, 2014, chapter 6. Every number below is of this run, and every verdict is computed from it.</p>\n" +
      heading_html(page.heading) + verdicts_html(page.figures) +
      "<section id=\"speed-error\">\n<h2>Speed against error</h2>\n";
  if (std::none_of(page.rows.begin(), page.rows.end(), shown))
    text += "<p class=\"problem\">No cache was measured.</p>\n";
  else
    text +=
        "<p>Each point is a cache at one number of rays: the time it saves, against what it gets wrong, both against "
        "the same rays without a cache. Points without an error lie on the bottom of the axis, those that take twice "
        "the time or more on its left end. The table has the most rays of each.</p>\n" +
        page.svg + table_html(speed_error_numbers(page.rows));
  text += "</section>\n";
  for (const Section& figure : page.figures) text += section_html(figure);
  return html_page("Ray orders and ray caches", std::string("body{max-width:840px}") + verdict_style(), text);
}

std::string thesis_markdown(const ThesisPage& page) {
  std::string text = "# Ray orders and ray caches: the thesis' figures, measured\n\n" + heading_markdown(page.heading) +
                     "\n## Verdicts\n\n" + markdown(outcome_counts(page.figures)) + "\n\n" +
                     markdown(verdicts_of(page.figures)) + "\n\n## Speed against error\n\n";
  if (std::none_of(page.rows.begin(), page.rows.end(), shown))
    text += "No cache was measured.\n";
  else if (page.svg.empty())
    text += "There is no plot, because gnuplot is absent or failed; the numbers are in thesis.csv.\n";
  else
    text += "![Speed against error of all caches](thesis.svg)\n";
  for (const Section& figure : page.figures) {
    text += fmt::format("\n## {}: {}\n\n", figure.name, figure.title);
    if (!figure.words.paragraph.empty()) text += figure.words.paragraph + "\n\n";
    if (!figure.svg.empty()) text += fmt::format("![{}]({}.svg)\n\n", figure.caption, figure.name);
    for (const std::string& note : figure.notes) text += "- " + note + "\n";
    if (!figure.problem.empty()) text += "- " + figure.problem + "\n";
  }
  return text;
}

}  // namespace wavetracer::study
