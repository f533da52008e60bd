// What inputs say of materials, and what two of them come to.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "materials.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace {

/// Find the cohesion of two materials, by the geometric mean; false if theirs are not of one kind.
bool cohere(const CaromMaterial &one, const CaromMaterial &other, const CaromMaterial &both,
            CaromBodies &bodies) {
    const auto of = [&](const CaromMaterial &own) {
        const double modulus = bodies.pair.modulus;
        if (own.jkr > 0.0) return carom_cohesion(CaromCohesion::jkr, own.jkr, modulus);
        if (own.dmt > 0.0) return carom_cohesion(CaromCohesion::dmt, own.dmt, modulus);
        if (own.pulloff > 0.0) return carom_cohesion(CaromCohesion::pulloff, own.pulloff, modulus);
        return CaromCohesion{};
    };
    bodies.cohesion = of(both);
    if (both.jkr >= 0.0 || both.dmt >= 0.0 || both.pulloff >= 0.0) return true;
    const CaromCohesion first = of(one), second = of(other);
    bodies.cohesion = carom_cohesion(first.kind, std::sqrt(first.value) * std::sqrt(second.value),
                                     bodies.pair.modulus);
    return first.kind == second.kind;
}

}  // namespace

std::string carom_read(CaromMaterial &given, const std::string &word, double value) {
    struct Word {
        const char *name;
        double CaromMaterial::*place;
        bool good;
        const char *allowed;
    };
    const auto within = [&](double low, double high) { return value >= low && value <= high; };
    const Word known[] = {
        {"young", &CaromMaterial::young, within(1e-20, 1e20), "must be from 1e-20 to 1e20"},
        {"poisson", &CaromMaterial::poisson, value > -1.0 && value <= 0.5, "must be above -1 and at most 0.5"},
        {"friction", &CaromMaterial::friction, within(0.0, 1e6), "must be from 0 to 1e6"},
        {"retardation", &CaromMaterial::retardation, within(0.0, 1e20), "must be from 0 to 1e20"},
        {"restitution", &CaromMaterial::restitution, within(0.01, 1.0), "must be from 0.01 to 1"},
        {"speed", &CaromMaterial::speed, within(1e-20, 1e20), "must be from 1e-20 to 1e20"},
        {"jkr", &CaromMaterial::jkr, within(0.0, 1e20), "must be from 0 to 1e20"},
        {"dmt", &CaromMaterial::dmt, within(0.0, 1e20), "must be from 0 to 1e20"},
        {"pulloff", &CaromMaterial::pulloff, within(0.0, 1e20), "must be from 0 to 1e20"},
    };
    const CaromMaterial nothing;
    for (const Word &each : known)
        if (word == each.name) {
            if (given.*each.place != nothing.*each.place) return "is given twice";
            given.*each.place = value;
            return each.good ? "" : each.allowed;
        }
    return "is not known; young, poisson, friction, retardation, restitution, speed, jkr, dmt and "
           "pulloff are";
}

std::string carom_flaw(const CaromMaterial &given) {
    if ((given.restitution >= 0.0) != (given.speed >= 0.0))
        return "give restitution and the speed at which it holds";
    if (given.restitution >= 0.0 && given.retardation >= 0.0)
        return "give retardation or restitution, not both";
    if ((given.jkr >= 0.0) + (given.dmt >= 0.0) + (given.pulloff >= 0.0) > 1)
        return "give one of jkr, dmt and pulloff";
    return "";
}

std::string carom_combine(const CaromMaterial &one, const CaromMaterial &other,
                          const CaromMaterial &both, CaromBodies &found) {
    const auto solid = [&](const CaromMaterial &own) {
        return carom::Material{both.young > 0.0 ? both.young : own.young,
                               both.poisson > -1.0 ? both.poisson : own.poisson};
    };
    const double friction =
        both.friction >= 0.0 ? both.friction : std::sqrt(one.friction) * std::sqrt(other.friction);
    CaromMaterial mixed = both;
    if (both.retardation < 0.0 && both.restitution < 0.0) {
        if ((one.restitution >= 0.0) != (other.restitution >= 0.0)) return "one has a restitution, the other none";
        if (one.restitution >= 0.0) {
            mixed.restitution = std::sqrt(one.restitution * other.restitution);
            mixed.speed = std::sqrt(one.speed * other.speed);
        } else {
            mixed.retardation =
                0.5 * (std::max(one.retardation, 0.0) + std::max(other.retardation, 0.0));
        }
    }
    found.pair = carom::pair_of(solid(one), solid(other), {1.0, 1.0}, {1.0, 1.0}, friction,
                                std::max(mixed.retardation, 0.0));
    found.share = carom::share_of(solid(one), solid(other));
    found.loss = mixed.restitution >= 0.0 ? carom::loss_of(mixed.restitution) : 0.0;
    found.speed = mixed.speed;
    return cohere(one, other, both, found) ? "" : "the cohesion is not of one kind";
}

double carom_retardation(const CaromBodies &bodies, const carom::Pair &pair) {
    return carom::retardation_of(bodies.loss, pair, bodies.speed);
}

}  // namespace LAMMPS_NS
