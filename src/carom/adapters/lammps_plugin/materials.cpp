// What inputs say of materials, and what two of them come to.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "materials.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace {

/// Velocity after a normal impact with this alpha: d'' = -(5/4) sqrt(s) (d + alpha d' - ...), the
/// contact of Hertz's springs with s at the edge where d + alpha d' ends, by the header itself.
double rebound(double alpha) {
    carom::Pair pair{1.0, 1e6, 1.0, 0.0, 1.0, alpha};
    pair.modulus = 0.9375 / std::sqrt(pair.radius);  // so that d_max = V_1 = 1
    carom::Contact<8, double, carom::viscous> contact{};
    carom::Load load{};
    const double step = 2e-4;
    double depth = 0.0, speed = 1.0;
    for (int i = 0; i < 1000000; ++i) {
        speed -= 0.5 * step * load.normal;
        depth += step * speed;
        carom::advance(contact, pair, {depth, speed, 0.0, 0.0, step}, load);
        speed -= 0.5 * step * load.normal;
        if (speed < 0.0 && load.normal <= 0.0) break;
    }
    return -speed;
}

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

double carom_loss(double restitution) {
    if (restitution > 0.9999) return 1e4 * (1.0 - restitution) * carom_loss(0.9999);
    double low = 0.0, high = 1.0;
    while (rebound(high) > restitution) high *= 2.0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (rebound(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
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
    found.loss = mixed.restitution >= 0.0 ? carom_loss(mixed.restitution) : 0.0;
    found.speed = mixed.speed;
    return cohere(one, other, both, found) ? "" : "the cohesion is not of one kind";
}

double carom_retardation(const CaromBodies &bodies, const carom::Pair &pair) {
    const double natural = 0.9375 * pair.mass / (pair.modulus * std::sqrt(pair.radius));
    return bodies.loss * std::pow(natural, 0.4) * std::pow(bodies.speed, -0.2);
}

}  // namespace LAMMPS_NS
