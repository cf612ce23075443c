// The page and its picture: strings only.
// Assumes SVG as gnuplot writes it, with its identifiers in quotes and references that begin with #.
#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <tuple>
#include "study/cache_words.hpp"
#include "study/ray_counts.hpp"
#include "study/thesis.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::study {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// Of every study, drive and setting the row with the most rays; settings without a cache of their own, which others are
// measured by, are left out.
std::vector<CacheRow> best_known(const std::vector<CacheRow>& rows) {
  const auto key = [](const CacheRow& row) { return std::tie(row.study, row.drive, row.setting); };
  std::map<std::tuple<std::string, std::string, std::string>, uint64_t> most;
  for (const CacheRow& row : rows) most[key(row)] = std::max(most[key(row)], row.rays);
  std::vector<CacheRow> out;
  for (const CacheRow& row : rows)
    if (row.depth == 0 && row.rays == most.at(key(row))) out.push_back(row);
  return out;
}

bool shown(const CacheRow& row) { return row.depth == 0 && row.error.reference_paths > 0 && row.cache.on; }

std::string table_html(const std::vector<CacheRow>& rows) {
  std::string text =
      "<table>\n<thead><tr><th>study</th><th>world</th><th>setting</th><th>rays</th><th>division</th>"
      "<th>position step</th><th>time saved</th>"
      "<th>look-ups answered</th><th>lost paths</th><th>spurious paths</th><th>lost power</th><th>delay spread</th>"
      "<th>centroid L1</th><th>centroid L2</th></tr></thead>\n<tbody>\n";
  for (const CacheRow& row : best_known(rows)) {
    if (!shown(row)) continue;
    const study::PathError& e = row.error;
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:g} m</td><td>{:.1f} "
        "%</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{} ns</td><td>{}</td><td>{}</td></tr>\n",
        escaped(row.study), escaped(row.drive), escaped(row.setting), grouped(row.rays), grouped(row.division),
        row.position_step_m, row.saved_percent, share_words(hit_rate(row)), share_words(e.lost_share),
        share_words(e.spurious_share),
        e.lost_power > 0 ? fmt::format("{:.1f} dB", study::share_db(e.lost_power)) : "none",
        plain(e.delay_spread_ns, 2), share_words(e.l1_relative), share_words(e.l2_relative));
  }
  return text + "</tbody>\n</table>\n";
}

std::string html_table(const NumberTable& table) {
  std::string text = table.caption.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(table.caption));
  text += "<table>\n<thead><tr>";
  for (const std::string& head : table.heads) text += fmt::format("<th>{}</th>", escaped(head));
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += fmt::format("<td>{}</td>", escaped(cell));
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

// Every claim with what was measured, and where more of it is.
std::string verdicts_html(const std::vector<ThesisFigure>& figures) {
  std::string text =
      "<section id=\"verdicts\">\n<h2>Verdicts</h2>\n<table class=\"words\">\n<thead><tr><th>figure</th>"
      "<th>claim</th><th>measured</th></tr></thead>\n<tbody>\n";
  for (const ThesisFigure& figure : figures) {
    std::vector<Verdict> verdicts = figure.words.verdicts;
    if (figure.words.paragraph.empty())
      verdicts = {{figure.title, figure.problem}};
    else if (verdicts.empty())
      verdicts = {{figure.title, "no claim to judge; the numbers are in its section"}};
    for (const auto& [claim, measured] : verdicts)
      text += fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td></tr>\n", figure.name,
                          escaped(claim), escaped(measured));
  }
  return text +
         "</tbody>\n</table>\n<p><a href=\"#speed-error\">Speed against error of all caches</a></p>\n"
         "</section>\n";
}

std::string figure_html(const ThesisFigure& figure) {
  std::string text =
      fmt::format("<section id=\"{}\">\n<h2>{}: {}</h2>\n", figure.name, figure.name, escaped(figure.title));
  if (!figure.problem.empty()) text += fmt::format("<p class=\"problem\">{}</p>\n", escaped(figure.problem));
  if (!figure.words.paragraph.empty()) text += fmt::format("<p>{}</p>\n", escaped(figure.words.paragraph));
  if (!figure.words.verdicts.empty()) text += html_table(verdict_table(figure.words.verdicts));
  text += figure.svg;
  if (!figure.words.numbers.rows.empty()) text += html_table(figure.words.numbers);
  if (!figure.notes.empty()) {
    text += "<ul>\n";
    for (const std::string& note : figure.notes) text += fmt::format("<li>{}</li>\n", escaped(note));
    text += "</ul>\n";
  }
  return text + "<p><a href=\"#verdicts\">All verdicts</a></p>\n</section>\n";
}

constexpr const char* style =
    "body{font:16px/1.5 sans-serif;max-width:1280px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;font-size:13px}td,th{border-bottom:1px solid #ddd;padding:2px 8px;text-align:right}"
    "td:nth-child(-n+3),th:nth-child(-n+3){text-align:left}svg{max-width:100%;height:auto}"
    "ul{font-size:13px;color:#555}.problem{color:#b00}";

}  // namespace

std::string escaped(std::string text) {
  replace_all(text, "&", "&amp;");
  replace_all(text, "<", "&lt;");
  replace_all(text, ">", "&gt;");
  replace_all(text, "\"", "&quot;");
  return text;
}

std::string family(const std::string& setting) {
  std::string text = setting;
  for (const uint32_t hash : {1u, 2u, 3u}) {
    const std::string ending = " " + hash_name(hash);
    if (const size_t at = text.find(ending); at != std::string::npos) text.erase(at, ending.size());
  }
  return text;
}

std::string speed_error_table(const std::vector<CacheRow>& rows) {
  std::vector<CacheRow> points;
  for (const CacheRow& row : rows)
    if (shown(row)) {
      points.push_back(row);
      points.back().setting = family(row.setting);
    }
  return encode_cache_table(points);
}

std::string speed_error_script(const std::vector<CacheRow>& rows, const std::string& device) {
  LinePlot plot;
  plot.name = "thesis";
  plot.title = "Speed against error of all caches, " + device;
  plot.columns = cache_columns();
  for (const CacheRow& row : rows)
    if (shown(row) && std::find(plot.settings.begin(), plot.settings.end(), family(row.setting)) == plot.settings.end())
      plot.settings.push_back(family(row.setting));
  plot.x = "saved_percent";
  plot.x_label = "time saved (%)";
  plot.points = true;
  plot.least_x = -100;
  // No error is drawn at the bottom of an axis.
  plot.panels = {{"lost power", "lost_power", "share", "", true, 1e-7},
                 {"lost paths", "lost_share", "share", "", true, 1e-5},
                 {"spurious paths", "spurious_share", "share", "", true, 1e-5},
                 {"delay spread", "delay_spread_ns", "ns", "", true, 1e-4},
                 {"centroid, L1, of the mean path", "l1_relative", "share", "", true, 1e-6},
                 {"centroid, L2, of the mean path", "l2_relative", "share", "", true, 1e-6}};
  return line_plot_script(plot);
}

std::string inline_svg(const std::string& document, const std::string& prefix) {
  const size_t begin = document.find("<svg");
  if (begin == std::string::npos) return "";
  std::string text = document.substr(begin);
  replace_all(text, "xmlns=\"http://www.w3.org/2000/svg\"", "");
  replace_all(text, "xmlns:xlink=\"http://www.w3.org/1999/xlink\"", "");
  replace_all(text, "id=\"", "id=\"" + prefix);
  replace_all(text, "id='", "id='" + prefix);
  replace_all(text, "xlink:href='#", "href='#" + prefix);
  replace_all(text, "url(#", "url(#" + prefix);
  return text;
}

std::string thesis_html(const ThesisPage& page) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Ray orders and ray "
      "caches</title>\n<style>{}</style>\n</head>\n<body>\n<h1>Ray orders and ray caches: the thesis' figures, "
      "measured</h1>\n<p>The claims are those of A. Zhdanov, TU Munich, 2014, chapter 6. Every number below is of "
      "this run, and every verdict is computed from it.</p>\n<ul>\n<li>device: {} ({}, driver {})</li>\n<li>scene: "
      "{}</li>\n<li>date: {}, wavetracer {}</li>\n<li>command: <code>{}</code></li>\n</ul>\n",
      style, escaped(page.device.name), escaped(page.device.platform), escaped(page.device.driver), escaped(page.scene),
      page.date, WAVETRACER_VERSION, escaped(page.command_line));
  text += verdicts_html(page.figures);
  text += "<section id=\"speed-error\">\n<h2>Speed against error</h2>\n";
  if (std::none_of(page.rows.begin(), page.rows.end(), shown))
    text += "<p class=\"problem\">No cache was measured.</p>\n";
  else
    text +=
        "<p>Each point is a cache at one number of rays: the time it saves, against what it gets wrong, both against "
        "the same rays without a cache. Points without an error lie on the bottom of the axis, those that take twice "
        "the time or more on its left end. The table has the most rays of each.</p>\n" +
        page.svg + table_html(page.rows);
  text += "</section>\n";
  for (const ThesisFigure& figure : page.figures) text += figure_html(figure);
  return text + "</body>\n</html>\n";
}

}  // namespace wavetracer::study
