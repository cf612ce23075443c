// SPDX-License-Identifier: Apache-2.0
// Three edges and more in a row: the integral of edge_pair.h over as many heights as there are edges.
//   the integral over u_1, u_2, ... > 0 of exp(-j (sum of u_i^2 + 2 x_i u_i - 2 r_i u_i u_(i+1)))
// If all heights are turned by -45 degrees, the coupling of two neighbours is a real exponential and everything decays.
// So a Gaussian rule for the half line computes it with a dozen heights for each edge: L. Vogler's multiple integral
// (Radio Science 17(6), 1982), to half a per cent for eight screens of one height (tests/radio/edge_chain_test.cpp).
#ifndef WAVETRACER_DEVICE_EDGE_CHAIN_H
#define WAVETRACER_DEVICE_EDGE_CHAIN_H
#include "wavetracer/device/edge_pair.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

#define WT_CHAIN_NODES 12

// The waves above an edge, at its heights, times the weights of the rule. side: see wt_pair_terms; index 0 is -1, 1 is
// 1.
typedef struct {
  double heights[WT_CHAIN_NODES];
  wt_matrix at[2][WT_CHAIN_NODES];
} wt_chain_waves;

// The part of a chain that was computed so far. from: that of its first edge; to: that of its last edge. `sum` is the
// wave between them, once the last edge has been added.
typedef struct {
  wt_chain_waves waves;
  wt_pair_terms terms;    // those of the last edge
  wt_shared_plane plane;  // that of the leg to the next edge
  wt_pair_form form;      // that of the same leg
  wt_basis from, to;
  wt_matrix sum;
} wt_chain;

// The heights of an edge and their weights: Gauss' rule for exp(-t^2) on t > 0, scaled to the range of the integrand,
// which decays faster for a larger least argument of the edge's terms, and slower for edges that are close (r near 1).
inline void wt_chain_rule(double least_argument, double coupling, double* heights, double* weights) {
  const double nodes[WT_CHAIN_NODES] = {0.0298897007698256528, 0.15420487826598317, 0.366143962974457171,
                                        0.650881015845339972,  0.99436686988091405, 1.38589120364967533,
                                        1.8188486084283324,    2.29084273867294597, 2.8040967933937071,
                                        3.36727070416300123,   4.00168347567355109, 4.76821628798992148};
  const double factors[WT_CHAIN_NODES] = {0.0763142950964157823, 0.17045144750390534,  0.250869954536382889,
                                          0.31622204438912016,   0.368954818627496905, 0.412993386651772598,
                                          0.452517330242128035,  0.491816231698735784, 0.536052532242250135,
                                          0.593551165637442368,  0.68372108735735071,  0.88444476547025952};
  const double close = fmin(3.0, 1.0 / sqrt((1.0 - coupling) * (1.0 + coupling)));
  const double scale = close / (1.0 + 0.3 * least_argument);
  for (int k = 0; k < WT_CHAIN_NODES; ++k) {
    heights[k] = scale * nodes[k];
    weights[k] = scale * factors[k] * wt_exp(-heights[k] * heights[k]);
  }
}

// The term of an edge with the least argument, among the two of the incident wave or among all, as count says.
inline int wt_nearest_term(const wt_pair_terms* terms, int count) {
  int nearest = 0;
  for (int i = 1; i < count; ++i)
    if (terms->argument[i] < terms->argument[nearest]) nearest = i;
  return nearest;
}

// The leg to the next edge: the coupling of heights and, over a plane, what the plane reflects. come: from the edge
// before to the polarizations at the plane; go: from there to the next edge; without a plane, go is the whole way.
typedef struct {
  double coupling;
  int over_plane;
  double sides;
  wt_double2 te, tm;
  wt_matrix come, go;
} wt_chain_leg;

inline void wt_come_to_height(const wt_chain_waves* waves, const wt_chain_leg* leg, double height, wt_matrix* arrived) {
  wt_matrix sums[2];
  sums[0] = sums[1] = wt_diagonal(wt_real(0.0), wt_real(0.0));
  for (int k = 0; k < WT_CHAIN_NODES; ++k) {
    const double power = 2.0 * leg->coupling * waves->heights[k] * height;
    const double same = wt_exp(power), other = wt_exp(-power);
    for (int side = 0; side < 2; ++side) {
      sums[side] = wt_matrix_sum(sums[side], same, waves->at[side][k]);
      sums[side] = wt_matrix_sum(sums[side], other, waves->at[1 - side][k]);
    }
  }
  for (int side = 0; side < 2; ++side) {
    if (!leg->over_plane) {
      arrived[side] = wt_matrix_product(leg->go, sums[side]);
      continue;
    }
    const wt_matrix direct = wt_matrix_product(leg->come, sums[side]);
    const wt_matrix image = wt_matrix_product(leg->come, sums[1 - side]);
    wt_matrix both;
    for (int i = 0; i < 4; ++i) both.m[i] = direct.m[i] * leg->sides + wt_times(image.m[i], i < 2 ? leg->te : leg->tm);
    arrived[side] = wt_matrix_product(leg->go, both);
  }
}

// The leg from the chain's last edge to the next one. between: see wt_diffract_at_pair.
inline wt_chain_leg wt_chain_leg_of(const wt_chain* chain, const wt_pair_terms* next, const wt_transfer* between,
                                    wt_basis coming, double wavelength_m) {
  const wt_shared_plane* plane = &chain->plane;
  const wt_pair_form* form = &chain->form;
  wt_chain_leg leg;
  leg.coupling = form->coupling;
  leg.over_plane = plane->sides > 0;
  leg.sides = (double)plane->sides;
  leg.te = leg.tm = wt_real(0.0);
  leg.go = wt_seen_in(between, coming);
  leg.come = wt_diagonal(wt_real(1.0), wt_real(1.0));
  if (!leg.over_plane) return leg;
  const int i = wt_nearest_term(&chain->terms, 2), j = wt_nearest_term(next, 2);
  const double r = form->coupling * (-chain->terms.side[i] * next->side[j]);
  const wt_double2 image = wt_double_transition(chain->terms.argument[i], next->argument[j], -r);
  wt_reflection_over_plane(&chain->terms, next, i, j, form, plane, wavelength_m, r, image, &leg.te, &leg.tm);
  const wt_double3 k = wt_cross3(between->rows.first, between->rows.second);
  const wt_basis polarizations = wt_polarizations(k, plane->normal);
  const wt_matrix identity = wt_diagonal(wt_real(1.0), wt_real(1.0));
  leg.come = wt_seen_in(between, polarizations);
  leg.go = wt_turned(identity, polarizations, coming);
  return leg;
}

// Adds an edge. terms: those of a second edge; along: not 0 where a face of it is grazed, so its terms of reflection do
// not count; leg: the leg to it, null at the first edge; coupling: the larger one of those to its neighbours, by size;
// amplitude: that of the edge.
inline void wt_add_edge(wt_chain* chain, const wt_bend* bend, const wt_pair_terms* terms, int along,
                        const wt_chain_leg* leg, double coupling, wt_double2 amplitude) {
  const int count = along ? 2 : WT_BOUNDARIES;
  const wt_chain_waves before = chain->waves;
  double weights[WT_CHAIN_NODES];
  wt_chain_rule(terms->argument[wt_nearest_term(terms, count)], coupling, chain->waves.heights, weights);
  chain->sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  // This is the factor 2j exp(-j pi / 4) of the turned integral.
  const wt_double2 front = wt_times(amplitude, WT_DOUBLE2(1.41421356237309504880, 1.41421356237309504880));
  for (int k = 0; k < WT_CHAIN_NODES; ++k) {
    const double height = chain->waves.heights[k];
    wt_matrix arrived[2];
    if (leg) wt_come_to_height(&before, leg, height, arrived);
    chain->waves.at[0][k] = chain->waves.at[1][k] = wt_diagonal(wt_real(0.0), wt_real(0.0));
    for (int term = 0; term < count; ++term) {
      const double fall = 1.41421356237309504880 * terms->argument[term] * height;
      const wt_double2 wave = wt_cos_sin(-fall) * (wt_exp(-fall) * weights[k] * terms->ratio[term]);
      wt_matrix out = terms->jump[term];
      if (leg) out = wt_matrix_product(out, arrived[terms->side[term] > 0]);
      out = wt_scaled(out, wt_times(wave, front));
      // The terms of the incident wave are lit more on the opposite side of the leg that leaves.
      const int leaves = term / 2 == 1 ? terms->side[term] > 0 : terms->side[term] < 0;
      chain->waves.at[leaves][k] = wt_matrix_sum(chain->waves.at[leaves][k], 1.0, out);
      chain->sum = wt_matrix_sum(chain->sum, 1.0, out);
    }
  }
  if (!leg) chain->from = bend->from;
  chain->to = bend->to;
  chain->terms = *terms;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
