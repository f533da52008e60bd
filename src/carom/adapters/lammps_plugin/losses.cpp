// What each sphere loses, kept where an input has given vectors for it.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "losses.h"

#include <algorithm>

#include "atom.h"
#include "error.h"

using namespace LAMMPS_NS;

namespace {
constexpr int both = 2;
const char *const names[both] = {"lost_friction", "lost_viscosity"};
}  // namespace

void CaromLosses::begin(const char *style, bool ledger) {
    for (int k = 0; k < both; ++k) {
        int is_double = 0, columns = 0;
        places[k] = atom->find_custom(names[k], is_double, columns);
        if (places[k] >= 0 && (!is_double || columns != 0))
            error->all(FLERR, "{}: {} must be a vector, d_{} of fix property/atom", style, names[k],
                       names[k]);
    }
    if (are_kept() && !ledger)
        error->all(FLERR, "{}: what d_lost_friction and d_lost_viscosity hold is known by ledger yes "
                          "only", style);
}

double *CaromLosses::vector(int k) const {
    return places[k] < 0 ? nullptr : atom->dvector[places[k]];
}

void CaromLosses::add(int i, double friction, double viscosity) {
    const double lost[both] = {friction, viscosity};
    for (int k = 0; k < both; ++k)
        if (places[k] >= 0) vector(k)[i] += lost[k];
}

void CaromLosses::clear_ghosts() {
    for (int k = 0; k < both; ++k)
        if (places[k] >= 0) std::fill_n(vector(k) + atom->nlocal, atom->nghost, 0.0);
}

int CaromLosses::pack(int count, int first, double *buffer) const {
    for (int i = first; i < first + count; ++i)
        for (int k = 0; k < both; ++k) *buffer++ = places[k] < 0 ? 0.0 : vector(k)[i];
    return both * count;
}

void CaromLosses::unpack(int count, const int *atoms, const double *buffer) {
    for (int n = 0; n < count; ++n) add(atoms[n], buffer[both * n], buffer[both * n + 1]);
}
