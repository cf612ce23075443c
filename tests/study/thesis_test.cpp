// SPDX-License-Identifier: Apache-2.0
// Tests the thesis' page without a device: its figures, its picture, its HTML.
// Tags are balanced with a small stack of their names; void elements and gnuplot's self-closing ones close themselves.
#include "study/thesis.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <regex>
#include "base/xml_text.hpp"
#include "contains.hpp"
#include "study/made_cache_rows.hpp"
#include "study/squeezed.hpp"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

// The first tag that does not fit, or an empty text.
std::string unbalanced(const std::string& html) {
  static const std::regex tag(R"(<(/?)([a-zA-Z][a-zA-Z0-9]*)((?:[^>"']|"[^"]*"|'[^']*')*)>)");
  std::vector<std::string> open;
  for (std::sregex_iterator at(html.begin(), html.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2], rest = (*at)[3];
    if (name == "meta" || rest.ends_with("/")) continue;
    if ((*at)[1].length() == 0) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name) return "/" + name;
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

// This is the form that gnuplot writes.
const std::string drawing =
    "<?xml version=\"1.0\" encoding=\"utf-8\"  standalone=\"no\"?>\n<svg \n width=\"400\" height=\"300\"\n "
    "xmlns=\"http://www.w3.org/2000/svg\"\n xmlns:xlink=\"http://www.w3.org/1999/xlink\"\n>\n<g id=\"gnuplot_canvas\">"
    "<path id='gpPt0' d='M-1,0 h2'/><use xlink:href='#gpPt0' id='gpPt1'/></g></svg>\n";

ThesisPage page() {
  ThesisPage out;
  out.heading.device.name = "A <device> & \"driver\"";
  out.heading.command_line = "wavetracer thesis all --set 'a=\"b\"'";
  out.heading.date = "2014-05-15";
  const CacheStudy& study = *find_experiment("figure-6.11").study();
  out.rows = made_measurement(study, {1000, 5000}, [](const std::string& setting, uint64_t) {
               return std::pair{setting == "no cache" ? 1.0 : 0.75, setting == "position mixed" ? 2.0 : 0.0};
             }).rows;
  out.svg = inline_svg(drawing, "thesis-");
  for (const Experiment* experiment : thesis_experiments()) {
    Section figure{.name = experiment->name, .title = experiment->title};
    figure.words = {
        "a < b & c", {{"a > b", ClaimOutcome::in_part, "not <confirmed>"}}, {"Numbers:", {"x"}, {{"1 & 2"}}}};
    figure.svg = inline_svg(drawing, experiment->name + "-");
    figure.notes = {"a note"};
    out.figures.push_back(figure);
  }
  return out;
}

}  // namespace

TEST_CASE("the page has figures 6.1 to 6.18 in order, then what goes beyond them") {
  const std::vector<const Experiment*> figures = thesis_experiments();
  REQUIRE(figures.size() == 22);
  for (size_t i = 0; i < 18; ++i) CHECK(figures[i]->name == "figure-6." + std::to_string(i + 1));
  CHECK(figures[18]->name == "cache-division");
  CHECK(figures[19]->name == "cache-step");
  CHECK(figures[20]->name == "innerframe");
  CHECK(figures[21]->name == "innerframe-ordered");
}

TEST_CASE("the page is well formed, names every figure, and refers to nothing outside of it") {
  const std::string html = thesis_html(page());
  CHECK(html.starts_with("<!DOCTYPE html>\n"));
  CHECK(unbalanced(html) == "");
  for (const Experiment* experiment : thesis_experiments())
    CHECK(contains(html, "<section id=\"" + experiment->name + "\">"));
  CHECK_FALSE(contains(html, "http"));
  CHECK(contains(html, "A &lt;device&gt; &amp; &quot;driver&quot;"));
  CHECK(contains(html, "a &lt; b &amp; c"));
  CHECK(contains(html, "2014-05-15"));
  CHECK(contains(html, "--set 'a=&quot;b&quot;'"));
  // Identifiers occur once.
  std::vector<std::string> ids;
  static const std::regex id(R"( id=["']([^"']+)["'])");
  for (std::sregex_iterator at(html.begin(), html.end(), id), end; at != end; ++at) ids.push_back((*at)[1]);
  std::sort(ids.begin(), ids.end());
  CHECK(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
  CHECK(contains(html, "href='#figure-6.5-gpPt0'"));
}

TEST_CASE("the page begins with a table of all verdicts, whose links lead to sections") {
  ThesisPage made = page();
  made.figures[4].words.verdicts.clear();
  made.figures[5] = {.name = "figure-6.6", .title = "Operations", .words = {}, .problem = "failed: no memory"};
  const std::string html = thesis_html(made);
  const size_t begin = html.find("<section id=\"verdicts\">"), end = html.find("</section>", begin);
  REQUIRE(begin < html.find("<section id=\"speed-error\">"));
  const std::string table = html.substr(begin, end - begin);
  for (const Section& figure : made.figures)
    CHECK(contains(table, "<td><a href=\"#" + figure.name + "\">" + figure.name + "</a></td>"));
  CHECK(contains(
      table, "<td>a &gt; b</td><td><span class=\"verdict in-part\">in part</span></td><td>not &lt;confirmed&gt;</td>"));
  CHECK(contains(table, "#figure-6.5\">figure-6.5</a></td><td>" + xml_text(made.figures[4].title) +
                            "</td><td><span class=\"verdict not-judged\">not judged</span></td><td>no claim to judge"));
  CHECK(contains(table,
                 "<td>Operations</td><td><span class=\"verdict not-measured-there\">not measured there</span></td>"
                 "<td>failed: no memory</td>"));
  // Every link leads to a section, and numbers are a table in theirs.
  static const std::regex link(R"re(<a href="#([^"]+)")re");
  size_t links = 0;
  for (std::sregex_iterator at(html.begin(), html.end(), link), none; at != none; ++at, ++links)
    CHECK(contains(html, "<section id=\"" + (*at)[1].str() + "\">"));
  CHECK(links >= 2 * made.figures.size() + 1);
  CHECK(contains(html, "<thead><tr><th>x</th></tr></thead>\n<tbody>\n<tr><td>1 &amp; 2</td></tr>"));
  // No number has an exponent.
  CHECK_FALSE(std::regex_search(html, std::regex(R"([0-9]e[-+][0-9])")));
}

TEST_CASE("claims are counted by origin and verdict, figures without one and figures that failed not at all") {
  std::vector<Section> figures(3);
  figures[0].words = {"text",
                      {{"a", ClaimOutcome::refuted, ""},
                       {"b", ClaimOutcome::exceeded, "", Origin::other},
                       {"c", ClaimOutcome::refuted, ""}},
                      {}};
  figures[1].words = {
      "text", {{"d", ClaimOutcome::reproduced, "", Origin::repetition}, {"e", ClaimOutcome::not_judged, ""}}, {}};
  const std::string counts = squeezed(markdown(outcome_counts(figures)));
  CHECK(contains(counts,
                 "| origin | claims | exceeded | reproduced | in part | refuted | undecided | not measured there | not "
                 "judged |"));
  CHECK(contains(counts, "| thesis | 3 | 0 | 0 | 0 | 2 | 0 | 0 | 1 |"));
  CHECK(contains(counts, "| other author | 1 | 1 | 0 | 0 | 0 | 0 | 0 | 0 |"));
  CHECK(contains(counts, "| repetition | 1 | 0 | 1 | 0 | 0 | 0 | 0 | 0 |"));
  const std::string text = squeezed(thesis_markdown({.heading = {}, .rows = {}, .svg = "", .figures = figures}));
  CHECK(contains(text, "| thesis | 3 | 0 |"));
  CHECK(contains(text, "| figure | claim | origin | verdict | measured |"));
  CHECK(contains(text, "| d | repetition | reproduced |"));
}

TEST_CASE("every verdict has a colour of its own, and a repetition says that it is one") {
  for (const ClaimOutcome outcome : outcomes()) {
    std::string kind(word(outcome));
    std::ranges::replace(kind, ' ', '-');
    CHECK(contains(verdict_style(), "." + kind));
  }
  CHECK(contains(verdict_cells({"a", ClaimOutcome::refuted, "b", Origin::repetition}), ">repetition</span></td>"));
  CHECK_FALSE(contains(verdict_cells({"a", ClaimOutcome::refuted, "b"}), "thesis"));
}

TEST_CASE("the table has the most rays of every cache") {
  const std::string html = thesis_html(page());
  CHECK(contains(html, "<tr><td>purging</td><td>fixed</td><td>position mixed</td><td>5,000</td>"));
  CHECK_FALSE(contains(html, "<td>position mixed</td><td>1,000</td>"));
  CHECK(contains(html, "<td>25.0 %</td><td>75%</td><td>10%</td><td>none</td><td>-30.0 dB</td>"));
  CHECK_FALSE(contains(html, "<td>no cache</td>"));
}

TEST_CASE("a figure that failed or was not reached is said to have, and the rest is there") {
  ThesisPage broken = page();
  broken.figures[3] = {.name = "figure-6.4", .title = "Hits"};
  broken.figures[3].problem = "failed: no memory <left>";
  broken.rows.clear();
  const std::string html = thesis_html(broken);
  CHECK(unbalanced(html) == "");
  CHECK(contains(html, "failed: no memory &lt;left&gt;"));
  CHECK(contains(html, "No cache was measured"));
  CHECK(contains(html, "<section id=\"figure-6.18\">"));
}

TEST_CASE("the picture: caches without their hash, a point per row, none of the reference") {
  CHECK(family("position Morton") == "position");
  CHECK(family("chained mixed 500000 entries") == "chained 500000 entries");
  CHECK(family("precision 0.0125 uniform") == "precision 0.0125");
  CHECK(family("concurrent exact") == "concurrent exact");
  const ThesisPage one = page();
  const plots::Figure drawn = speed_error_figure(one.rows, "the device's");
  const std::string table = drawn.data.front().text, script = drawn.commands;
  const auto points = std::count_if(one.rows.begin(), one.rows.end(), [](const CacheRow& row) { return row.cache.on; });
  CHECK(std::count(table.begin(), table.end(), '\n') == 1 + points);
  CHECK_FALSE(contains(table, "no cache,"));
  for (const char* column : {"lost power", "lost paths", "spurious paths", "delay spread", "L1", "L2"})
    CHECK(contains(script, column));
  CHECK(contains(script, "the device''s"));
}

TEST_CASE("svg: without prolog and namespaces, identifiers of its own; what is no svg is nothing") {
  const std::string svg = inline_svg(drawing, "p-");
  CHECK(svg.starts_with("<svg"));
  CHECK_FALSE(contains(svg, "xmlns"));
  CHECK(contains(svg, "id=\"p-gnuplot_canvas\""));
  CHECK(contains(svg, "<use href='#p-gpPt0' id='p-gpPt1'/>"));
  CHECK(inline_svg("no picture", "p-") == "");
}
