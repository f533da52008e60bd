// What is said once a run of contacts that are too short or too deep, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_WATCH_H
#define CAROM_WATCH_H

#include <string>

#include "kinds.h"
#include "pointers.h"

namespace LAMMPS_NS {

class CaromWatch : protected Pointers {
  public:
    CaromWatch(class LAMMPS *lmp, const char *style) : Pointers(lmp), style(style) {}

    /// Begin a run: spheres are moved as far as their forces say, by fix nve/limit, or by minimize.
    void begin();

    /// See bodies that touch for the first time: by too few steps they gain energy.
    void meet(const carom::Pair &, const carom::Encounter &, tagint one, tagint other);

    /// Let bodies overlap by more than R* under fix nve/limit: they are taken to be flatter then.
    void soften(carom::Pair &, double depth, tagint one, tagint other);

    /// Stop LAMMPS if a contact could not be brought to the end of a step.
    void check(carom::Status, const carom::Pair &, double depth, tagint one, tagint other) const;

    bool limits() const { return limit; }
    bool minimizes() const { return minimize; }

    static constexpr tagint wall = 0;  ///< in place of the other atom

  private:
    std::string who(tagint one, tagint other) const;

    const char *style;
    bool limit = false, minimize = false, coarse = false, deep = false;
};

}  // namespace LAMMPS_NS

#endif
