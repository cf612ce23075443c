// SPDX-License-Identifier: Apache-2.0
// Standard output of the program: where it leads, and whether everything printed has arrived there.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

namespace wavetracer::app {

// Must be called first: if the caller has closed one of the descriptors 0 to 2, it is opened in a way that makes its
// use fail. Otherwise the first written file would get its number, and messages would be printed into that file.
void keep_standard_streams();

// Flushes standard output, and returns its first problem since the program began, or an empty text if everything has
// arrived.
std::string output_problem();

// Returns the stream for a message about a written file: standard output, or standard error if that file is standard
// output itself (-o /dev/stdout).
std::ostream& word_about(const std::filesystem::path& written);

}  // namespace wavetracer::app
