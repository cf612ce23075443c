// SPDX-License-Identifier: Apache-2.0
// The ray cache: its records, the key of a ray, and the hash and mapping functions, for host and device alike.
// They follow A. Zhdanov, TU Munich, 2014, sections 4.2.3 to 4.2.5 and appendix C; comments say where this code
// corrects it.
#ifndef WAVETRACER_DEVICE_CACHE_H
#define WAVETRACER_DEVICE_CACHE_H
#include "wavetracer/device/records.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Each component of a direction is cut into `division` cells, at most this many: three cells fit into 63 bits.
#define WT_CACHE_MAX_DIVISION 0x1FFFFFu
// Entries in a bucket of the concurrent table; their tags are one sector of memory.
#define WT_CACHE_BUCKET 8u
// A search in a tree or over buckets takes at most this many steps; then it counts as a miss or a dropped write.
#define WT_CACHE_MAX_STEPS 64u
#define WT_CACHE_PROBES 4u  // the most buckets that are searched

// A traced segment. Most questions read only the first half, which is one sector of memory.
typedef struct {
  wt_ulong cells;   // cells of the ray's direction, see wt_cache_cells
  wt_uint left;     // primitive that the ray left, WT_NONE at a transmitter: instance and primitive in one number
  wt_uint version;  // even: whole; odd: being written; 0: never written (H. Boehm, MSPC 2012, figure 6)
  float t;          // the result, as in a hit list; infinite on a miss
  wt_uint primitive;
  wt_uint surface;
  wt_uint time;     // frame in which it was written; WT_NONE: withdrawn, because something has moved
  float origin[3];  // the ray that was traced
  float direction[3];
  wt_uint next;      // entry of the next segment of a ray that used this one, WT_NONE: not known
  wt_uint receiver;  // with reception spheres, cache.scope = "all": first receiver that it passed, or WT_NONE
} wt_cache_entry;

// The part of the table that belongs to one transmitter.
typedef struct {
  wt_uint first_entry, entries;
  wt_uint first_bucket, buckets;
  wt_uint since;  // frame since which the transmitter's position key has not changed; older entries are stale
  wt_uint stamp;  // hash of that key, never 0; the thesis' table as printed compares it
} wt_cache_region;

// Only with cache.statistics: cycles of the device's clock (lib/clock.clh) that the last answer and last write of an
// entry took.
typedef struct {
  wt_uint read, write;
} wt_cache_cycles;

// Counts of events other than plain hits and misses.
typedef struct {
  wt_uint conflicts;   // look-ups that met a writer or a reader, counted as misses
  wt_uint stale;       // look-ups that found an entry of their key that purging has made invalid
  wt_uint stored;      // entries written
  wt_uint replaced;    // those that replaced another entry
  wt_uint duplicates;  // writes of a key that was there already
  wt_uint dropped;     // writes that met another writer or found no place
  wt_uint exhausted;   // those that were dropped because no entry was free
  wt_uint evicted;     // entries removed by cache_purge
  wt_uint linked;      // look-ups that the entry linked from the one before answered
} wt_cache_counters;

// Cell of one component of a unit vector, 0 to division - 1 (as in listing 5.2, where a component of 1 gets a cell of
// its own).
inline wt_uint wt_cache_cell(float component, wt_uint division) {
  const float scaled = (component + 1.0f) * (0.5f * (float)division);
  return scaled < 1.0f ? 0u : scaled < (float)division - 1.0f ? (wt_uint)scaled : division - 1u;
}

inline wt_ulong wt_cache_cells(float x, float y, float z, wt_uint division) {
  return (wt_ulong)wt_cache_cell(x, division) | (wt_ulong)wt_cache_cell(y, division) << 21 |
         (wt_ulong)wt_cache_cell(z, division) << 42;
}

// Numbers that hashes take besides the ray: how many bits its fields have.
typedef struct {
  wt_uint cell_bits, surface_bits, primitive_bits;
} wt_cache_widths;

// Returns x modulo the prime 2^32 - 5 without a division: 2^32 is 5 modulo this prime.
inline wt_ulong wt_cache_modulo(wt_ulong x) {
  x = (x >> 32) * 5u + (x & 0xFFFFFFFFu);  // below 6 * 2^32
  x = (x >> 32) * 5u + (x & 0xFFFFFFFFu);  // below 2^32 + 26
  return x >= 0xFFFFFFFBu ? x - 0xFFFFFFFBu : x;
}

// Adds one more number to a hash of a sequence (P. Morin, Open Data Structures, 5.2.3, listing 4.2). All is unsigned,
// since sums and products of the listing overflow its signed integers. *s and *power are modulo 2^32 - 5.
inline void wt_cache_add(wt_uint number, wt_ulong* s, wt_ulong* power) {
  const wt_uint reduced = (number * 0x5067D19Du) >> 1;  // reduced to 31 bits: multiplicative hash with an odd factor
  *s = wt_cache_modulo(*s + wt_cache_modulo(*power * reduced));
  *power = wt_cache_modulo(*power * 0x64B6055Au);
}

// hash_method 1: uniform. The hash is in the upper 32 bits, where the mapping expects it.
inline wt_ulong wt_cache_hash1(wt_ulong cells, wt_uint left, wt_uint surface) {
  wt_ulong s = 0, power = 1;
  wt_cache_add(left, &s, &power);
  wt_cache_add(surface, &s, &power);
  wt_cache_add((wt_uint)cells & 0x1FFFFFu, &s, &power);
  wt_cache_add((wt_uint)(cells >> 21) & 0x1FFFFFu, &s, &power);
  wt_cache_add((wt_uint)(cells >> 42), &s, &power);
  s = wt_cache_modulo(s + wt_cache_modulo(power * 0xFFFFFFFAu));
  return s << 32;
}

// The upper 12 of the `bits` bits of a component's values (the listing takes the lower 7, which say nothing about where
// it is).
inline wt_ulong wt_cache_upper12(wt_uint value, wt_uint bits) {
  return (bits > 12u ? value >> (bits - 12u) : value << (12u - bits)) & 0xFFFu;
}

// Puts four zero bits between each two of the 12 bits.
inline wt_ulong wt_cache_separate_by_4(wt_ulong x) {
  x = (x | x << 32) & 0x00000F00000000FFul;
  x = (x | x << 16) & 0x00000F0000F0000Ful;
  x = (x | x << 8) & 0x000C0300C0300C03ul;
  x = (x | x << 4) & 0x0084210842108421ul;
  return x;
}

// hash_method 2: a Morton code of five components, so that similar rays are near each other in the table (listing 4.3,
// with 60 bits). A surface number stands for the instance, since the surfaces of an instance are numbered in a row.
inline wt_ulong wt_cache_hash2(wt_ulong cells, wt_uint left, wt_uint surface, wt_cache_widths widths) {
  const wt_ulong x = wt_cache_upper12((wt_uint)cells & 0x1FFFFFu, widths.cell_bits);
  const wt_ulong y = wt_cache_upper12((wt_uint)(cells >> 21) & 0x1FFFFFu, widths.cell_bits);
  const wt_ulong z = wt_cache_upper12((wt_uint)(cells >> 42), widths.cell_bits);
  const wt_ulong u = wt_cache_upper12(surface, widths.surface_bits);
  const wt_ulong v = wt_cache_upper12(left, widths.primitive_bits);
  return (wt_cache_separate_by_4(x) | wt_cache_separate_by_4(y) << 1 | wt_cache_separate_by_4(z) << 2 |
          wt_cache_separate_by_4(u) << 3 | wt_cache_separate_by_4(v) << 4)
         << 4;
}

// The hash of a method: 1, 2, or 3, which is mixed, the sum of both (equation 4.2 with i = 1).
inline wt_ulong wt_cache_hash(wt_uint method, wt_ulong cells, wt_uint left, wt_uint surface, wt_cache_widths widths) {
  wt_ulong hash = 0;
  if (method != 2) hash += wt_cache_hash1(cells, left, surface);
  if (method != 1) hash += wt_cache_hash2(cells, left, surface, widths);
  return hash;
}

// A number that tells keys of one bucket apart, never 0: the finisher of MurmurHash3 over the key.
inline wt_uint wt_cache_tag(wt_ulong cells, wt_uint left) {
  wt_ulong x = cells ^ ((wt_ulong)left << 32 | (left * 0x9E3779B9u));
  x = (x ^ x >> 33) * 0xFF51AFD7ED558CCDul;
  x = (x ^ x >> 33) * 0xC4CEB9FE1A85EC53ul;
  const wt_uint tag = (wt_uint)(x ^ x >> 33);
  return tag ? tag : 1u;
}

// The bucket of a hash: hashes are spread evenly over 0 to buckets - 1 for every number of buckets (equation 4.3
// reaches only half of them, and in float32 at most 2^24).
inline wt_uint wt_cache_bucket(wt_ulong hash, wt_uint buckets) {
  return (wt_uint)(((hash >> 32) * buckets + ((hash & 0xFFFFFFFFu) * buckets >> 32)) >> 32);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
