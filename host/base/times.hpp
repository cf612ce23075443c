// Times in seconds as doubles: how precise they are, and how they are written for people.
// Near 1.7e9 s, as which times since 1970 are kept, neighbouring doubles are 0.24 us apart: a time that a file gives in
// decimal digits is up to half of that beside its double, and the difference of two times by up to all of it.
#pragma once
#include <string>

namespace wavetracer {

// The distance from this time to the next double.
double time_spacing_s(double time_s);

// Two times that differ by no more are one instant: a microsecond, since k * step is not the decimal number of a file
// to the last bit, or two spacings where doubles are coarser than that.
double time_tolerance_s(double time_s);

// The number with the fewest decimal digits within `error` of a value, or the value itself if it needs all of them.
double simplest_decimal(double value, double error);

// "1700000000.1": the time, rounded to a microsecond; below a millisecond it is rounded to six digits instead.
std::string time_text(double time_s);

}  // namespace wavetracer
