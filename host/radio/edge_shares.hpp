// Shares tell how much of a diffracted wave is one with a wave that passes the edge straight or is reflected at one of
// its faces. At a shadow boundary both leave the edge in one direction, and they are one wave; the farther from it, the
// longer is the detour over the edge, and where it is two wavelengths they are two waves, whose powers add up.
#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "wavetracer/device/records.h"

namespace wavetracer {

// The place of an edge in the path of another wave.
enum class InPlace : uint8_t { edge, nothing, face_0, face_1 };
constexpr size_t in_places = 4;

// Amplitudes by InPlace, whose squares add up to 1; shares[InPlace::edge] is of the wave that is one with no other.
using EdgeShares = std::array<double, in_places>;

// The detour, in wavelengths, from which on a diffracted wave is one with no other.
constexpr double most_detour = 2;

// wedge: where it is in the frame. k_in, k_out: unit, before and after it. before_m, after_m: unfolded lengths from the
// edge to the ends of the path. Shares are continuous in all of these, but where two boundaries meet.
EdgeShares edge_shares(const wt_wedge& wedge, const glm::dvec3& k_in, const glm::dvec3& k_out, double before_m,
                       double after_m, double wavelength_m);

}  // namespace wavetracer
