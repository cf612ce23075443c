// SPDX-License-Identifier: Apache-2.0
// Text between tags is escaped here, and nowhere else.
// Cells must not contain line ends.
#include "study/page.hpp"
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <ctime>
#include <fstream>
#include <sstream>
#include "study/run.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string device_words(const DeviceSummary& device) {
  return fmt::format("{} ({}, driver {})", device.name, device.platform, device.driver);
}

std::string items_html(const std::vector<std::string>& items) {
  std::string text = "<ul class=\"about\">\n";
  for (const std::string& item : items) text += fmt::format("<li>{}</li>\n", item);
  return text + "</ul>\n";
}

}  // namespace

Heading heading_of(const Config& config, const DeviceSummary& device, const std::string& command_line) {
  const std::string& file = config.scene.file;
  return {.device = device,
          .scene = file.empty() ? "city " + config.scene.generate : fs::path(file).filename().string(),
          .command_line = command_line,
          .date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))};
}

Section section_of(const Experiment& experiment, const Findings& found) {
  return {.name = experiment.name,
          .title = experiment.title,
          .caption = experiment.caption,
          .words = found.words,
          .notes = found.notes};
}

std::string heading_markdown(const Heading& heading) {
  return fmt::format("- device: {}\n- scene: {}\n- date: {}, wavetracer {}\n- command: `{}`\n",
                     device_words(heading.device), heading.scene, heading.date, WAVETRACER_VERSION,
                     heading.command_line);
}

std::string page_markdown(const Section& section, const Heading& heading) {
  std::string text = fmt::format("# {}\n\n{}\n\n![{}]({}.svg)\n\n{}", section.title, words_text(section.words),
                                 section.caption, section.name, heading_markdown(heading));
  for (const std::string& note : section.notes) text += "- " + note + "\n";
  return text;
}

std::string escaped(std::string text) {
  replace_all(text, "&", "&amp;");
  replace_all(text, "<", "&lt;");
  replace_all(text, ">", "&gt;");
  replace_all(text, "\"", "&quot;");
  return text;
}

std::string cells_html(const std::vector<std::string>& cells, const char* tag) {
  std::string text;
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return text;
}

std::string table_html(const NumberTable& table) {
  std::string text = table.caption.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(table.caption));
  text += "<table>\n<thead><tr>" + cells_html(table.heads, "th") + "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) text += "<tr>" + cells_html(row, "td") + "</tr>\n";
  return text + "</tbody>\n</table>\n";
}

std::string heading_html(const Heading& heading, const std::vector<std::string>& more) {
  std::vector<std::string> items = {"device: " + escaped(device_words(heading.device)),
                                    "scene: " + escaped(heading.scene)};
  for (const std::string& item : more) items.push_back(escaped(item));
  items.push_back(fmt::format("date: {}, wavetracer {}", heading.date, WAVETRACER_VERSION));
  items.push_back(fmt::format("command: <code>{}</code>", escaped(heading.command_line)));
  return items_html(items);
}

std::string section_html(const Section& section) {
  std::string text =
      fmt::format("<section id=\"{}\">\n<h2>{}: {}</h2>\n", section.name, section.name, escaped(section.title));
  if (!section.problem.empty()) text += fmt::format("<p class=\"problem\">{}</p>\n", escaped(section.problem));
  if (!section.words.paragraph.empty()) text += fmt::format("<p>{}</p>\n", escaped(section.words.paragraph));
  if (!section.words.verdicts.empty()) text += table_html(verdict_table(section.words.verdicts));
  text += section.svg;
  if (!section.words.numbers.rows.empty()) text += table_html(section.words.numbers);
  std::vector<std::string> notes;
  for (const std::string& note : section.notes) notes.push_back(escaped(note));
  if (!notes.empty()) text += items_html(notes);
  return text + "<p><a href=\"#verdicts\">All verdicts</a></p>\n</section>\n";
}

std::string document_html(const std::string& title, const std::string& style, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
      "charset=\"utf-8\">\n<title>{}</title>\n<style>body{{font:16px/"
      "1.5 sans-serif;margin:2em auto;padding:0 1em;color:#222}}table{{border-collapse:collapse;font-size:13px}}td,th{{"
      "border-bottom:1px solid #ddd;padding:2px "
      "8px;text-align:right}}td:nth-child(-n+3),th:nth-child(-n+3){{text-align:"
      "left}}svg{{max-width:100%;height:auto}}.about{{font-size:13px;color:#555}}{}</style>\n</head>\n<body>\n{}</"
      "body>\n"
      "</html>\n",
      escaped(title), style, body);
}

std::string file_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
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

}  // namespace wavetracer::study
