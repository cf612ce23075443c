// SPDX-License-Identifier: Apache-2.0
// Three edges and more of a path, one after the other (edge_chain.h). Edges at an angle to each other are treated as
// parallel edges whose coupling is that of their projections.
#ifndef WAVETRACER_DEVICE_PATH_CHAIN_H
#define WAVETRACER_DEVICE_PATH_CHAIN_H
#include "wavetracer/device/edge_chain.h"
#include "wavetracer/device/path_edges.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Adds edge i; edges are added in their order. plane: the plane along which its leg to the next edge runs; between: see
// wt_diffract_at_pair.
// An edge whose legs both run along planes has the images in both, which are the same waves twice.
inline void wt_add_to_chain(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                            const wt_path* path, const wt_edge* edges, wt_uint count, wt_uint i,
                            const wt_shared_plane* plane, const wt_transfer* between, wt_chain* chain) {
  const wt_edge* edge = edges + i;
  const double distance_m = wt_sine2(edge) / (1.0 / edge->before_m + 1.0 / edge->after_m);
  const int comes_along = i > 0 && chain->plane.sides > 0, leaves_along = plane->sides > 0;
  wt_known_waves known;
  const wt_bend bend = wt_bend_on_path(world, ordered, row, path, edge, &known);
  const wt_pair_terms terms = wt_pair_terms_of(&bend, &known, distance_m, 1, comes_along || leaves_along);
  double share = comes_along && leaves_along ? 0.5 : 1.0;
  if (!comes_along && wt_grazes(bend.turn.in, edge->frame.exterior)) share *= 0.5;
  if (!leaves_along && wt_grazes(bend.turn.away, edge->frame.exterior)) share *= 0.5;
  const wt_double2 amplitude = wt_edge_amplitude(distance_m, bend.n) * share;
  wt_chain_leg leg;
  double coupling = 0.0;
  if (i > 0) {
    leg = wt_chain_leg_of(chain, &terms, between, bend.from, world->wavelength_m);
    coupling = fabs(leg.coupling);
  }
  if (i + 1 < count) {
    chain->form = wt_form_between(edge);
    coupling = fmax(coupling, fabs(chain->form.coupling));
  }
  wt_add_edge(chain, &bend, &terms, comes_along || leaves_along, i > 0 ? &leg : 0, coupling, amplitude);
  chain->plane = *plane;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
