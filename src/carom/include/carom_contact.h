/* carom_contact.h: the exact contact of spheres, step by step, for C and languages that call it.
 *
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What carom/contact.hpp is for C++; to be compiled with your program:
 *
 *     c++ -std=c++17 -O3 -march=native -fno-math-errno -c
 *         -I$INCLUDE $INCLUDE/carom/contact.cpp
 *
 * $INCLUDE is what `python -c "import carom; print(carom.get_include())"` prints. Of every contact
 * keep carom_contact_size(springs, parts) bytes, aligned as doubles, zero before the first touch.
 */
#ifndef CAROM_CONTACT_H
#define CAROM_CONTACT_H

#include <stddef.h>

#include "carom/own_names.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a contact remembers besides its springs, and how precisely; add what is wanted. */
enum carom_parts { CAROM_ELASTIC = 0, CAROM_VISCOUS = 1, CAROM_LEDGER = 2, CAROM_SINGLE = 4 };

enum carom_contact_status {
    CAROM_CONTACT_OK = 0,
    CAROM_BAD_PAIR = 1,
    CAROM_BAD_MOTION = 2,
    CAROM_BAD_KIND = 3 /* springs other than 16, 32, 64, or unknown parts */
};

/* Two bodies: E*, R*, kappa = G* / E*, mu, m_1 m_2/(m_1 + m_2), retardation time, and whether shear
 * loses energy, too. */
struct carom_pair {
    double modulus, radius, stiffness_ratio, friction, mass, retardation;
    int viscous_shear;
};

/* A step: penetration at its end, velocities in its middle (approach is positive while the bodies
 * approach), its length. */
struct carom_motion {
    double penetration, approach, slide_x, slide_y, step;
};

/* Forces at its end, x and y against the slide; energies lost in it if there is a ledger. */
struct carom_load {
    double normal, x, y, friction, viscosity;
};

/* Bytes that a contact keeps; 0 for a kind that is not offered. */
size_t carom_contact_size(int springs, unsigned parts);

/* Bring a contact to the end of a step. Unless 0 is returned, nothing has changed. */
int carom_contact_advance(void *contact, int springs, unsigned parts,
                          const struct carom_pair *pair, const struct carom_motion *motion,
                          struct carom_load *load);

/* The same for many contacts of one pair, which lie one after the other, carom_contact_size bytes
 * each, with their motions and loads. Returns 0 or the first status that is not; such a contact and
 * its load stay as they were. */
int carom_contact_advance_many(void *contacts, int springs, unsigned parts,
                               const struct carom_pair *pair, const struct carom_motion *motions,
                               struct carom_load *loads, size_t count);

/* One line for what was returned. */
const char *carom_contact_message(int status);

#ifdef __cplusplus
}
#endif

#include "carom/own_names.h"

#endif
