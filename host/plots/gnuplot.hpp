// SPDX-License-Identifier: Apache-2.0
// gnuplot as a program: colours that all pictures share, quoting for its scripts, and running one.
// Scripts only name files of their own folder, so that the folder can be moved and the script run again.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace wavetracer::plots {

// Eight colours that colour-blind readers can tell apart: M. Okabe, K. Ito, "Color Universal Design", 2008, except for
// its yellow, which is too pale for a line on white.
constexpr std::array<std::string_view, 8> colours = {"#000000", "#e69f00", "#56b4e9", "#009e73",
                                                     "#999999", "#0072b2", "#d55e00", "#cc79a7"};

// Quotes text for single quotes of a script: quotes are doubled, control characters replaced by spaces.
std::string quoted(const std::string& text);

// Runs the script in its folder. Returns an empty text, or one line that says why there is no plot and what to do.
std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script);

}  // namespace wavetracer::plots
