// SPDX-License-Identifier: Apache-2.0
// Times in seconds as doubles: their precision, and how they are printed.
// Near 1.7e9 s (times since 1970), neighbouring doubles are 0.24 us apart: a time given in decimal digits differs from
// its double by up to half of that, and the difference of two times by up to all of it.
#pragma once
#include <string>

namespace wavetracer {

// Returns the distance from this time to the next double.
double time_spacing_s(double time_s);

// Returns the largest difference of two times that count as the same instant: a microsecond, since k * step is not
// exactly the decimal number of a file, or two spacings where doubles are coarser than that.
double time_tolerance_s(double time_s);

// Returns the number with the fewest decimal digits within `error` of a value, or the value itself if it needs all its
// digits.
double simplest_decimal(double value, double error);

// Returns how long something takes, with three digits: "1.66 s", "383 ms", "1,230 s".
std::string duration_text(double seconds);

// Returns text such as "1700000000.1": the time rounded to a microsecond, or, below a millisecond, to six digits.
std::string time_text(double time_s);

}  // namespace wavetracer
