// Three edges and more of a path, one after the other (edge_chain.h). Edges at an angle to each other are taken for
// parallel ones whose coupling is that of their projections.
#ifndef WAVETRACER_DEVICE_PATH_CHAIN_H
#define WAVETRACER_DEVICE_PATH_CHAIN_H
#include "wavetracer/device/edge_chain.h"
#include "wavetracer/device/path_edges.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Of the leg between edges i and i + 1.
inline wt_pair_form wt_form_between(const wt_edge* edges, wt_uint i) {
  const wt_edge *a = edges + i, *b = edges + i + 1;
  const wt_double3 along[2] = {a->frame.along, b->frame.along};
  const double sine2[2] = {wt_sine2(a), wt_sine2(b)};
  return wt_pair_form_of(along, a->k_out, a->before_m, a->after_m, b->after_m, sine2);
}

// Adds edge i, in their order. plane: to the next edge, which its legs run along; between: see wt_diffract_at_pair.
// Where both legs of an edge run along planes, the images in both are the same waves twice.
inline void wt_add_to_chain(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                            const wt_path* path, const wt_edge* edges, wt_uint count, wt_uint i,
                            const wt_shared_plane* plane, const wt_transfer* between, wt_chain* chain) {
  const wt_edge* edge = edges + i;
  const double legs_m[2] = {edge->before_m, edge->after_m};
  const double distance_m = wt_sine2(edge) / (1.0 / legs_m[0] + 1.0 / legs_m[1]);
  const int comes_along = i > 0 && chain->plane.sides > 0, leaves_along = plane->sides > 0;
  wt_turn turn;
  const wt_known_waves known = wt_known_at(world, ordered, row, path, edge, &turn);
  const wt_wedge_face faces[2] = {wt_face_of(world, edge, 0), wt_face_of(world, edge, 1)};
  const wt_bend bend = wt_bend_at(&edge->frame, faces, edge->k_in, edge->k_out, legs_m, &turn, world->wavelength_m,
                                  wt_edge_transmits(world, edge));
  const wt_pair_terms terms = wt_pair_terms_of(&bend, &known, distance_m, 1, comes_along || leaves_along);
  double share = comes_along && leaves_along ? 0.5 : 1.0;
  if (!comes_along && wt_grazes(turn.in, edge->frame.exterior)) share *= 0.5;
  if (!leaves_along && wt_grazes(turn.away, edge->frame.exterior)) share *= 0.5;
  if (!wt_turns(&edge->frame, edge->k_in, edge->k_out)) share = 0.0;
  const wt_double2 amplitude = wt_edge_amplitude(distance_m, bend.n) * share;
  double coupling = 0.0;
  if (i + 1 < count) coupling = fabs(wt_form_between(edges, i).coupling);
  if (i == 0) {
    wt_add_edge(chain, &bend, &terms, leaves_along, 0, coupling, amplitude);
  } else {
    const wt_pair_form form = wt_form_between(edges, i - 1);
    const wt_chain_leg leg = wt_chain_leg_of(chain, &terms, &form, between, bend.from, world->wavelength_m);
    wt_add_edge(chain, &bend, &terms, comes_along || leaves_along, &leg, fmax(coupling, fabs(form.coupling)),
                amplitude);
  }
  chain->plane = *plane;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
