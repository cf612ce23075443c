// SPDX-License-Identifier: Apache-2.0
// Folders in which a test finds its inputs, its outputs and the program. They are functions and not macros: a path of
// the machine in a source would be another source to ccache in every clone.
#pragma once

#include <string>

#include "folders.hpp"

namespace wavetracer::test {

std::string source_folder();  // the project's folder
std::string shared_folder();  // large test data, the CMake option test::shared_folder(); may be missing
std::string build_folder();   // the build folder
std::string program();        // the built wavetracer program

}  // namespace wavetracer::test
