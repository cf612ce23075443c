// SPDX-License-Identifier: Apache-2.0
// Spellings of material names, and what a [[material]] table may not say.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "wavetracer/config.hpp"

namespace wavetracer {

// Returns the name as written, without "mat-", and without "mat-" and "itu_".
std::array<std::string, 3> spellings(std::string_view name);

// Returns the kind of woodland of a name that needs no [[material]].
Woodland woodland_named(std::string_view name);

// Tells whether the table gives a law of permittivity and conductivity.
bool gives_law(const MaterialConfig& material);

// Returns the kind of woodland that a name stands for. over: its [[material]], or null.
Woodland woodland_of(std::string_view name, const MaterialConfig* over);

// Throws ConfigError that names the table.
void check_material(const MaterialConfig& material);

}  // namespace wavetracer
