// Contacts of the exact law as LAMMPS keeps them: numbers in the history of a pair of neighbours.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_KINDS_H
#define CAROM_KINDS_H

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "carom/contact_in_space.hpp"

namespace LAMMPS_NS {

/// What a style is asked for: springs in a contact, and what it keeps besides.
struct CaromOptions {
    int springs = 16;
    bool single = true, ledger = false, viscous = false;
    bool tangential = false;  ///< friction alone, beside a normal force of LAMMPS' own
};

// A contact in a history: the force on the first body, of pairs with the normal part that a part
// tangential leaves to another style, and the penetration then, the retardation
// time, which kind it is, by which a history of another one is told, the springs.
enum CaromPlaces { FORCE = 0, DEPTH = 3, RETARDATION = 4, KIND = 5, SPRINGS = 6 };

inline carom::Vector carom_vector(const double *x) { return {x[0], x[1], x[2]}; }

inline void carom_add(double *sum, double factor, const carom::Vector &more) {
    for (int i = 0; i < 3; ++i) sum[i] += factor * more[i];
}

/// Have numbers ready when they are needed.
inline void carom_fetch(const double *numbers, int count) {
    constexpr int line = 16;  // processors fetch cache lines in pairs
    for (int k = 0; k < count; k += line) __builtin_prefetch(numbers + k, 1);
}

/// Contacts that are brought to the end of a step together, which takes less time.
struct CaromBatch {
    static constexpr int most = 16;
    int count = 0;
    double *memories[most];
    carom::Pair pairs[most];
    carom::Encounters meetings[most / carom::lanes];
    carom::Actions actions[most / carom::lanes];
    carom::Status statuses[most];
};

/// What is done with a contact of one kind, which lies in so many doubles.
struct CaromKind {
    int doubles;
    double number;  ///< of the kind
    bool (*touches)(const double *);
    double (*stored)(const double *);  ///< energy, 0 without a ledger
    int lost;  ///< where what friction and viscosity took lies among the doubles, 0 without a ledger
    void (*advance)(CaromBatch &);
    void (*mirror)(double *);
};

/// Return the kind that options ask for; none (0 doubles) where there are other springs.
CaromKind carom_kind(const CaromOptions &);

/// Bring contacts to the end of a step. While LAMMPS sets up a run nothing moves: a contact that is
/// as it was has the force that it had.
void carom_step(const CaromKind &, CaromBatch &, bool setup);

/// Give contacts the force of Hertz alone: while LAMMPS minimizes no time passes.
void carom_press(CaromBatch &);

/// Return the part of a force along the surface.
inline carom::Vector carom_aside(const carom::Vector &force, const carom::Vector &normal) {
    return carom::plus(force, -carom::dot(force, normal), normal);
}

/// Keep what the next setup needs.
inline void carom_keep(double *memory, const carom::Vector &force, double depth) {
    std::copy(force.begin(), force.end(), memory + FORCE);
    memory[DEPTH] = depth;
}

/// Return the energy of a Hertzian contact.
inline double carom_pressed(const carom::Pair &pair, double depth) {
    const double pressed = std::max(depth, 0.0);
    return 8.0 / 15.0 * pair.modulus * pressed * pressed * std::sqrt(pair.radius * pressed);
}

}  // namespace LAMMPS_NS

#endif
