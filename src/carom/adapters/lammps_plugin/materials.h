// What inputs say of materials, and what two of them come to.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_MATERIALS_H
#define CAROM_MATERIALS_H

#include <string>

#include "carom/contact_in_space.hpp"
#include "cohesion.h"

namespace LAMMPS_NS {

/// A material, or what is said of two types; below their range where nothing is said.
struct CaromMaterial {
    double young = -1.0, poisson = -2.0, friction = -1.0, retardation = -1.0;
    double restitution = -1.0, speed = -1.0;
    double jkr = -1.0, dmt = -1.0, pulloff = -1.0;  ///< cohesion: two surface energies, a force

    bool complete() const { return young > 0.0 && poisson > -1.0 && friction >= 0.0; }
    bool lossy() const { return retardation > 0.0 || (restitution >= 0.0 && restitution < 1.0); }
};

/// Two materials: their bodies, and the loss (0 for none) that restitution at a speed stands for.
struct CaromBodies {
    carom::Pair pair{};
    double share = 0.5;  // of the penetration, by which the first is flattened
    double loss = 0.0, speed = 0.0;
    CaromCohesion cohesion{};
};

/// Take one word with its value; return what is wrong with it, empty if nothing.
std::string carom_read(CaromMaterial &, const std::string &word, double value);

/// Return what is wrong with all words together, empty if nothing.
std::string carom_flaw(const CaromMaterial &);

/// Find what two materials come to, `both` going before their means; return why they have no mean,
/// empty if they have.
std::string carom_combine(const CaromMaterial &one, const CaromMaterial &other,
                          const CaromMaterial &both, CaromBodies &);

/// Return the retardation time of a contact with this radius and mass.
double carom_retardation(const CaromBodies &, const carom::Pair &);

}  // namespace LAMMPS_NS

#endif
