// Standard output of the program: where it leads, and whether all that was printed has arrived there.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

namespace wavetracer::app {

// To be called first: descriptors 0 to 2 that the caller has closed are opened so that using them fails. Else the first
// file that is written would get their numbers, and messages would be printed into it.
void keep_standard_streams();

// Flushes standard output. What went wrong with it since the program began, in words; empty where all has arrived.
std::string output_problem();

// For a word about a file that was written: standard output, or standard error where that very file is standard output
// (-o /dev/stdout).
std::ostream& word_about(const std::filesystem::path& written);

}  // namespace wavetracer::app
