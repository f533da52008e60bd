// What LAMMPS finds in the plugin: pair_style carom, fix wall/carom.
//
// SPDX-License-Identifier: GPL-2.0-only
#include <cstring>

#include "error.h"
#include "fix_wall_carom.h"
#include "lammps.h"
#include "pair_carom.h"

using namespace LAMMPS_NS;

namespace {

/// What LAMMPS is told of a style (its developer guide, "Writing plugins").
struct Style {
    const char *version, *style, *name, *info, *author;
    union {
        void *(*v1)(LAMMPS *);
        void *(*v2)(LAMMPS *, int, char **);
    } creator;
    void *handle;
};

void *make_pair(LAMMPS *lmp) { return new PairCarom(lmp); }
void *make_wall(LAMMPS *lmp, int narg, char **arg) { return new FixWallCarom(lmp, narg, arg); }

}  // namespace

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle, void *registrar) {
    const auto tell = reinterpret_cast<void (*)(Style *, void *)>(registrar);
    LAMMPS *program = static_cast<LAMMPS *>(lmp);
    if (program->num_ver != CAROM_LAMMPS) {
        program->error->warning(FLERR,
                                "Carom's plugin was built for LAMMPS {}, this is {}: pair_style "
                                "carom is left out; build it again: carom lammps build",
                                CAROM_LAMMPS, program->num_ver);
        return;
    }
    Style style{};
    style.version = program->version;
    style.style = "pair";
    style.name = "carom";
    style.info = "the exact contact of spheres";
    style.author = "Carom";
    style.creator.v1 = &make_pair;
    style.handle = handle;
    tell(&style, lmp);
    style.style = "fix";
    style.name = "wall/carom";
    style.info = "the exact contact of spheres with regions";
    style.creator.v2 = &make_wall;
    tell(&style, lmp);
}
