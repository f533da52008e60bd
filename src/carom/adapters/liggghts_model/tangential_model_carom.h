// Tangential model carom: the exact contact of elastic spheres, for LIGGGHTS.
//
// SPDX-License-Identifier: GPL-2.0-only
//
//     pair_style gran model hertz tangential carom springs 16
//
// It is compiled with LIGGGHTS, with the folder `carom` of headers beside it. The normal force is
// that of the model hertz, with a coefficient of restitution of 1; or, with `part_tangential on`,
// with any damping, cohesion and rolling friction: these leave the limit of friction as it is.
#ifdef TANGENTIAL_MODEL
TANGENTIAL_MODEL(TANGENTIAL_CAROM,carom,20)
#else
#ifndef TANGENTIAL_MODEL_CAROM_H_
#define TANGENTIAL_MODEL_CAROM_H_

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "carom/contact_in_space.hpp"
#include "contact_models.h"
#include "error.h"
#include "global_properties.h"
#include "neighbor.h"
#include "tangential_model_base.h"
#include "update.h"

namespace LIGGGHTS {
namespace ContactModels {

/// How contacts of one number of springs lie in a history, and how they are stepped.
struct CaromKind {
    int doubles;
    carom::Status (*advance)(double *memory, bool other_side, bool keep, const carom::Pair &,
                             const carom::Encounter &, carom::Action &);
};

/// LIGGGHTS can change the sign of numbers when a contact goes to the other sphere, no more; so one
/// number tells that it has, and the rest is mirrored here.
template <int N> CaromKind carom_kind() {
    using Contact = carom::ContactInSpace<N, float>;
    CaromKind kind;
    kind.doubles = (sizeof(Contact) + sizeof(double) - 1) / sizeof(double);
    kind.advance = [](double *memory, bool other_side, bool keep, const carom::Pair &pair,
                      const carom::Encounter &now, carom::Action &action) {
        Contact contact{};
        // of a contact that ended between two lists of neighbours LIGGGHTS tells nothing
        const bool fresh = now.penetration + carom::dot(now.velocity, now.normal) * now.step <= 0.0;
        if (!fresh) std::memcpy(&contact, memory, sizeof contact);
        if (other_side) carom::mirror(contact);
        const carom::Status status = carom::advance(contact, pair, now, action);
        if (keep) std::memcpy(memory, &contact, sizeof contact);
        return status;
    };
    return kind;
}

template <> class TangentialModel<TANGENTIAL_CAROM> : public TangentialModelBase {
  public:
    TangentialModel(LAMMPS *lmp, IContactHistorySetup *setup, class ContactModelBase *base)
        : TangentialModelBase(lmp, setup, base) {}

    void registerSettings(Settings &settings) {
        settings.registerDoubleSetting("springs", springs, 16.0);
        settings.registerOnOff("part_tangential", part_tangential, false);
    }

    void postSettings(IContactHistorySetup *setup, ContactModelBase *) {
        if (springs == 16.0) kind = carom_kind<16>();
        else if (springs == 32.0) kind = carom_kind<32>();
        else if (springs == 64.0) kind = carom_kind<64>();
        else error->all(FLERR, "tangential carom: springs must be 16, 32 or 64");
        side = setup->add_history_value("carom_side", "1");
        for (int k = 0; k < kind.doubles; ++k)
            setup->add_history_value("carom_" + std::to_string(k), "0");
    }

    void connectToProperties(PropertyRegistry &registry) {
        registry.registerProperty("Yeff", &MODEL_PARAMS::createYeff);
        registry.registerProperty("Geff", &MODEL_PARAMS::createGeff);
        registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
        registry.connect("Yeff", modulus, "tangential_model carom");
        registry.connect("Geff", shear_modulus, "tangential_model carom");
        registry.connect("coeffFrict", friction, "tangential_model carom");
        if (double(neighbor->oneatom) * (1 + kind.doubles) > neighbor->pgsize)
            error->all(FLERR, "tangential carom: the memories of a sphere's contacts do not fit into "
                              "a page; fewer neighbors at most: neigh_modify one 200");
    }

    void surfacesIntersect(const SurfacesIntersectData &met, ForceData &one, ForceData &other) {
        if (met.contact_flags) *met.contact_flags |= CONTACT_TANGENTIAL_MODEL;
        // while a run is set up, or forces are only asked for, nothing moves
        const bool moves = met.computeflag && met.shearupdate;
        double *memory = met.contact_history + side;
        const carom::Encounter now = encounter(met, moves ? update->dt : 1e-6 * update->dt);
        const carom::Pair bodies = pair(met);
        if (moves && !told) tell_stiff(bodies, met.deltan);
        carom::Action action{};
        const carom::Status status =
            kind.advance(memory + 1, memory[0] < 0.0, moves, bodies, now, action);
        if (moves) memory[0] = 1.0;
        if (status != carom::Status::ok) fail(carom::message(status));
        const double normal = carom::dot(action.force, now.normal);
        const double share = met.is_wall ? met.area_ratio : 1.0;
        // what the models before this one have added; cohesion may leave met.Fn as it was
        const carom::Vector added = {one.delta_F[0], one.delta_F[1], one.delta_F[2]};
        const double excess = carom::dot(added, now.normal) - share * normal;
        if (!part_tangential && !(std::fabs(excess) <= 1e-4 * share * normal))
            fail("the normal force must be that of elastic spheres: model hertz, without cohesion, "
                 "coefficientRestitution 1; or give part_tangential on");
        if (part_tangential && !(std::fabs(met.kn * met.deltan - normal) <= 1e-4 * normal))
            fail("part_tangential on takes the limit of friction from Hertz's depth: model hertz");
        const carom::Vector force = carom::plus(action.force, -normal, now.normal);
        add(one, share, force, action.torque);
        if (!met.is_wall) add(other, 1.0, carom::times(-1.0, force), action.other_torque);
    }

    void surfacesClose(SurfacesCloseData &parted, ForceData &, ForceData &) {
        if (parted.contact_flags) *parted.contact_flags &= ~CONTACT_TANGENTIAL_MODEL;
        if (parted.contact_history)
            std::fill_n(parted.contact_history + side, 1 + kind.doubles, 0.0);
    }

    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}

  private:
    /// What LIGGGHTS knows of two bodies: its Geff is a quarter of G*.
    carom::Pair pair(const SurfacesIntersectData &met) const {
        const int i = met.itype, j = met.jtype;
        carom::Pair known{};
        known.modulus = modulus[i][j];
        known.stiffness_ratio = 4.0 * shear_modulus[i][j] / modulus[i][j];
        known.radius = met.is_wall ? met.radi : met.radi * met.radj / (met.radi + met.radj);
        known.friction = friction[i][j];
        known.mass = met.meff;
        return known;
    }

    /// What LIGGGHTS knows of their motion; its contact point lies at R - d/2.
    static carom::Encounter encounter(const SurfacesIntersectData &met, double step) {
        carom::Encounter now{};
        now.normal = {met.en[0], met.en[1], met.en[2]};
        now.velocity = carom::plus({met.vtr1, met.vtr2, met.vtr3}, met.vn, now.normal);
        now.penetration = met.deltan;
        now.spin = 0.5 * (about(met.omega_i, met) + (met.is_wall ? 0.0 : about(met.omega_j, met)));
        now.step = step;
        now.arm = met.cri;
        now.other_arm = met.is_wall ? 0.0 : met.crj;
        return now;
    }

    /// Say once where contacts are too stiff for the timestep under their load.
    void tell_stiff(const carom::Pair &bodies, double depth) {
        if (!carom::is_too_stiff(bodies, depth, update->dt)) return;
        told = true;
        const std::string longest = std::to_string(0.99 * carom::longest_step(bodies, depth) / update->dt);
        error->warning(FLERR, ("tangential carom: a contact is too stiff for the timestep under its load, "
                               "the motion may gain energy; give " + longest + " of it or less (said once)")
                                  .c_str());
    }

    static double about(const double *spin, const SurfacesIntersectData &met) {
        return spin[0] * met.en[0] + spin[1] * met.en[1] + spin[2] * met.en[2];
    }

    static void add(ForceData &sum, double share, const carom::Vector &force,
                    const carom::Vector &torque) {
        for (int k = 0; k < 3; ++k) {
            sum.delta_F[k] += share * force[k];
            sum.delta_torque[k] += share * torque[k];
        }
    }

    void fail(const char *why) {
        error->one(FLERR, (std::string("tangential carom: ") + why).c_str());
    }

    double springs = 16.0;
    bool part_tangential = false, told = false;
    CaromKind kind{};
    int side = 0;  ///< place in the history: 1, or -1 if it was the other sphere's; then the contact
    double **modulus = nullptr, **shear_modulus = nullptr, **friction = nullptr;
};

}  // namespace ContactModels
}  // namespace LIGGGHTS

#endif
#endif
