// What is said once a run of contacts that are too short or too deep, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_WATCH_H
#define CAROM_WATCH_H

#include <string>

#include "carom/impacts.hpp"
#include "kinds.h"
#include "pointers.h"

namespace LAMMPS_NS {

class CaromWatch : protected Pointers {
  public:
    CaromWatch(class LAMMPS *lmp, const char *style) : Pointers(lmp), style(style) {}

    /// Begin a run: spheres are moved as far as their forces say, by fix nve/limit, or by minimize.
    void begin();

    /// See bodies that are pressed: where steps are too long for their stiffness they gain energy.
    void press(const carom::Pair &pair, double depth, double step, tagint one, tagint other) {
        if (!stiff && !limit && !minimize && carom::is_too_stiff(pair, depth, step))
            tell_stiff(pair, depth, step, one, other);
    }

    /// See a wall that a sphere is pressed into at once, or let go by, further than it moves in a step.
    void jump(double depth, double normal_speed, double speed, double step, double radius, tagint atom);

    /// Let bodies overlap by more than R* under fix nve/limit: they are taken to be flatter then.
    void soften(carom::Pair &, double depth, tagint one, tagint other);

    /// Stop LAMMPS if a contact could not be brought to the end of a step.
    void check(carom::Status, const carom::Pair &, double depth, tagint one, tagint other) const;

    bool limits() const { return limit; }
    bool minimizes() const { return minimize; }

    static constexpr tagint wall = 0;  ///< in place of the other atom

  private:
    std::string who(tagint one, tagint other) const;
    void tell_stiff(const carom::Pair &, double depth, double step, tagint one, tagint other);

    const char *style;
    bool limit = false, minimize = false, stiff = false, jumped = false, deep = false;
};

}  // namespace LAMMPS_NS

#endif
