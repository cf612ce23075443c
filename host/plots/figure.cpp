// SPDX-License-Identifier: Apache-2.0
// Sizes are those of a screen; vector formats use 96 pixels per inch, and PNG has twice the pixels, so that it prints
// well. It needs gnuplot 5.2 or later with cairo terminals, as in Debian's gnuplot-nox.
#include "plots/figure.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include "base/colours.hpp"
#include "base/output_place.hpp"
#include "base/pending_file.hpp"
#include "plots/gnuplot.hpp"

namespace wavetracer::plots {
namespace {

namespace fs = std::filesystem;

std::string_view ending(Format format) { return format == Format::svg ? "svg" : format == Format::png ? "png" : "pdf"; }

std::string terminal(const Figure& figure, Format format) {
  const double w = figure.width_px, h = figure.height_px;
  switch (format) {
    case Format::svg:
      return fmt::format("svg size {:.0f},{:.0f} font 'sans-serif,13' background 'white'", w, h);
    case Format::png:
      return fmt::format(
          "pngcairo size {:.0f},{:.0f} fontscale 2 linewidth 2 pointscale 2 font 'sans-serif,10' background 'white'",
          2 * w, 2 * h);
    default:
      return fmt::format("pdfcairo size {:.2f}in,{:.2f}in font 'sans-serif,10' background 'white'", w / 96, h / 96);
  }
}

std::string script(const Figure& figure, Format format) {
  return fmt::format(
             "# Draws {0}.{1} from the CSV files beside it; run it in their folder: gnuplot {0}.gp\n"
             "set encoding utf8\n"
             "set terminal {2}\n"
             "set output '{0}.{1}'\n"
             "set datafile separator ','\n"
             "set title '{3}' noenhanced\n"
             "set border 3 linecolor '#444444'\n"
             "set tics nomirror out\n"
             "set cblabel offset 1.5,0\n"
             "set grid linetype 1 linecolor '#dddddd' linewidth 0.5\n",
             figure.name, ending(format), terminal(figure, format), quoted(figure.title)) +
         palette() + figure.commands;
}

}  // namespace

std::string palette() {
  std::string steps;
  for (size_t k = 0; k < viridis.size(); ++k)
    steps += fmt::format("{}{} '{}'", k == 0 ? "" : ", ", k, hex(viridis[viridis.size() - 1 - k]));
  return fmt::format("set palette defined ({})\n", steps);
}

std::string colour_range(const std::vector<double>& values_db, double span_db) {
  double lower = INFINITY, upper = -INFINITY;
  for (const double value : values_db)
    if (std::isfinite(value)) {
      lower = std::min(lower, value);
      upper = std::max(upper, value);
    }
  upper = 5 * std::ceil(upper / 5);
  lower = std::min(std::max(5 * std::floor(lower / 5), upper - span_db), upper - 5);
  return fmt::format("set cbrange [{:g}:{:g}]\n", lower, upper);
}

std::string log_tics(const std::string& axis, const std::string& low, const std::string& high) {
  return fmt::format(
      "if (({1}) > 0 && ({2}) < 100 * ({1})) {{ do for [k = floor(log10({1})):ceil(log10({2}))] {{ do for [m in '1 2 5'] "
      "{{ set {0}tics add (sprintf('%g', m * 10.0**k) m * 10.0**k) }} }} }}\n",
      axis, low, high);
}

namespace {

// Draws a picture with the script in the folder; an old or incomplete picture is removed.
void draw_picture(const fs::path& picture, const std::string& script_name, Drawn& out) {
  remove_old_file(picture);  // an old picture would not match the new data
  const std::string problem = run_gnuplot(picture.parent_path(), script_name);
  if (problem.empty())
    out.files.push_back(picture);
  else
    remove_old_file(picture);
  if (out.problem.empty()) out.problem = problem;
}

}  // namespace

Drawn draw(const Figure& figure, const std::vector<Format>& formats, const fs::path& folder) {
  PendingDirectory directory(folder);
  const std::string commands = script(figure, formats.front());
  std::vector<PendingFile> files;
  for (const DataFile& data : figure.data)
    files.emplace_back(directory.path() / data.name, std::as_bytes(std::span(data.text)));
  files.emplace_back(directory.path() / (figure.name + ".gp"), std::as_bytes(std::span(commands)));
  commit_together(files);
  directory.keep();
  Drawn out;
  for (const PendingFile& file : files) out.files.push_back(file.path());
  const auto picture = [&](Format format) {
    return directory.path() / fmt::format("{}.{}", figure.name, ending(format));
  };
  draw_picture(picture(formats.front()), figure.name + ".gp", out);
  for (size_t i = 1; i < formats.size() && out.problem.empty(); ++i) {
    const fs::path other = directory.path() / fmt::format(".{}.{}.gp", figure.name, ending(formats[i]));
    const std::string words = script(figure, formats[i]);
    PendingFile(other, std::as_bytes(std::span(words))).commit();
    draw_picture(picture(formats[i]), other.filename().string(), out);
    remove_old_file(other);
  }
  return out;
}

}  // namespace wavetracer::plots
