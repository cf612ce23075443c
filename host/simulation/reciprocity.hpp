// Reciprocity: where radio ends both send and receive, what is a path one way is a path the other way.
// Assumes that a transmitter and a receiver that are one end stand in the same point.
#pragma once
#include <cstdint>
#include <span>

#include "wavetracer/path_geometry.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// End a is transmitter t_a and receiver r_a, end b likewise: the links t_a -> r_b and t_b -> r_a are twins, and each
// path of one, its vertices reversed, is a path of the other.
//   paths: as distinct_paths leaves them.
// Returns the paths with the reversed ones of wanted links added, in the order and merged by the rule of
// distinct_paths. A sequence that both directions have keeps its own solution in each of them: they may differ in the
// last bits, since they were solved from different ends.
//   receiver_of_transmitter, transmitter_of_receiver: the other index of the same end, or no_end; one per end.
//   wanted: sorted. Links that are not wanted get no reversed paths, and keep what they have.
PathGeometry with_reversed_twins(PathGeometry paths, std::span<const uint32_t> receiver_of_transmitter,
                                 std::span<const uint32_t> transmitter_of_receiver, std::span<const Link> wanted);

}  // namespace wavetracer
