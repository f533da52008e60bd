// What each sphere loses, kept where an input has given vectors for it.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_LOSSES_H
#define CAROM_LOSSES_H

#include "pointers.h"

namespace LAMMPS_NS {

/// Vectors of fix property/atom, d_lost_friction and d_lost_viscosity: they move with the spheres.
class CaromLosses : protected Pointers {
  public:
    explicit CaromLosses(class LAMMPS *lmp) : Pointers(lmp) {}

    /// Look for the vectors, or stop LAMMPS if nobody fills them.
    void begin(const char *style, bool ledger);

    bool are_kept() const { return places[0] >= 0 || places[1] >= 0; }

    void add(int i, double friction, double viscosity);

    /// Let ghosts begin a step with nothing, to hand on what they collect.
    void clear_ghosts();
    int pack(int count, int first, double *buffer) const;
    void unpack(int count, const int *atoms, const double *buffer);

  private:
    double *vector(int k) const;

    int places[2] = {-1, -1};
};

}  // namespace LAMMPS_NS

#endif
