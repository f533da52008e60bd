// Two like spheres meet, with the force of the tangential model as LIGGGHTS would ask for it.
//
//     in_liggghts SPRINGS STEPS TURNS COHESION PSI...
//
// prints psi_2 of each psi_1. TURNS times within the contact it becomes the other sphere's, as when
// one of the two crosses a border; the slide is along y and z at once. COHESION is the part of the
// normal force that a model of cohesion takes away.
//
//     in_liggghts SPRINGS held SLIDE RATE...
//
// prints the force on spheres that slide in one step, pressed and at each rate of approach, against
// the slide and in parts of Coulomb's limit.
//
//     in_liggghts SPRINGS part COHESION
//
// prints that force on spheres that slide, with `part_tangential on`.
//
//     in_liggghts SPRINGS stiff STEP
//
// prints what is said, a line each, of spheres that are pressed to d = 0.3 in two such steps.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tangential_model_carom.h"

using namespace LIGGGHTS;
using namespace LIGGGHTS::ContactModels;
using carom::cross;
using carom::dot;
using carom::plus;
using carom::times;
using carom::Vector;

constexpr double radius = 1e6, friction = 0.3, kappa = 0.8, mass = 2.0, deepest = 1.0, speed = 1.0;
const double modulus = 0.9375 * 0.5 * mass / std::sqrt(0.5 * radius);  // so that d_max = V_1 = 1
const double duration = 2.9432751843247047;

struct Impact {
    LAMMPS lammps{{{}}, {0.0}, {200, 100000}};
    IContactHistorySetup setup;
    TangentialModel<TANGENTIAL_CAROM> model{&lammps, &setup, nullptr};
    double tables[3] = {modulus, 0.25 * kappa * modulus, friction};
    PropertyRegistry registry{{&tables[0], &tables[1], &tables[2]}};
    std::vector<double> memory;
    double cohesion;

    Impact(double springs, double share, bool part = false) : cohesion(share) {
        Settings settings{springs, part};
        model.registerSettings(settings);
        model.postSettings(&setup, nullptr);
        model.connectToProperties(registry);
        memory.assign(setup.changes_sign.size(), 0.0);
    }

    void turn() {
        for (std::size_t k = 0; k < memory.size(); ++k)
            if (setup.changes_sign[k]) memory[k] = -memory[k];
    }

    /// Force on the first sphere and torque on each, told from the side of either.
    void force(double side, double distance, Vector velocity, Vector spin, Vector &f, Vector &t) {
        SurfacesIntersectData met{};
        const Vector normal = {side, 0.0, 0.0};
        met.contact_history = memory.data();
        met.radi = met.radj = radius;
        met.meff = 0.5 * mass;
        met.deltan = 2.0 * radius - distance;
        met.cri = met.crj = radius - 0.5 * met.deltan;
        met.omega_i = met.omega_j = spin.data();
        Vector slide = plus(times(side, velocity), -2.0 * met.cri, cross(spin, normal));
        met.vn = dot(slide, normal);
        slide = plus(slide, -met.vn, normal);
        met.vtr1 = slide[0], met.vtr2 = slide[1], met.vtr3 = slide[2];
        for (std::size_t k = 0; k < 3; ++k) met.en[k] = normal[k];
        const double hertz =
            4.0 / 3.0 * modulus * std::sqrt(0.5 * radius) * std::pow(met.deltan, 1.5);
        met.kn = hertz / met.deltan;
        ForceData one, other;
        for (std::size_t k = 0; k < 3; ++k) {
            one.delta_F[k] = (1.0 - cohesion) * hertz * normal[k];
            other.delta_F[k] = -one.delta_F[k];
        }
        model.surfacesIntersect(met, one, other);
        for (std::size_t k = 0; k < 3; ++k) {
            f[k] = side * one.delta_F[k];
            t[k] = one.delta_torque[k];
            if (one.delta_F[k] != -other.delta_F[k]) throw std::runtime_error("forces");
        }
    }

    double held(double slide, double rate) {
        const double depth = 0.3 * deepest;
        if (!(lammps.update.dt > 0.0)) lammps.update.dt = 1e-3;
        const double limit = friction * 4.0 / 3.0 * modulus * std::sqrt(0.5 * radius) *
                             std::pow(depth, 1.5);
        Vector f{}, t{};
        force(1.0, 2.0 * radius - depth, {-rate, slide, 0.0}, {}, f, t);
        return -f[1] / limit;
    }

    double rebound(double psi, int steps, int turns) {
        const double dt = lammps.update.dt = duration / steps, slide = psi * friction / kappa;
        const double inertia = 0.4 * mass * radius * radius, half = std::sqrt(0.5);
        const Vector along = {0.0, half, half}, normal = {1.0, 0.0, 0.0};
        Vector velocity = plus(times(slide, along), -speed, normal), spin{}, f{}, t{};
        double distance = 2.0 * radius, side = 1.0;
        for (int step = 1; step <= 2 * steps && distance <= 2.0 * radius; ++step) {
            velocity = plus(velocity, 0.5 * dt / (0.5 * mass), f);
            spin = plus(spin, 0.5 * dt / inertia, t);
            distance += dt * velocity[0];
            f = t = Vector{};
            if (turns && step % (steps / (turns + 1)) == 0) {
                turn();
                side = -side;
            }
            if (distance < 2.0 * radius) force(side, distance, velocity, spin, f, t);
            velocity = plus(velocity, 0.5 * dt / (0.5 * mass), f);
            spin = plus(spin, 0.5 * dt / inertia, t);
        }
        const Vector left = plus(velocity, -2.0 * radius, cross(spin, normal));
        return kappa / friction * dot(left, along);
    }
};

int main(int, char **given) try {
    const double springs = std::atof(given[1]);
    if (std::strcmp(given[2], "held") == 0) {
        for (char **rate = given + 4; *rate; ++rate)
            std::printf("%.17g\n", Impact(springs, 0.0).held(std::atof(given[3]), std::atof(*rate)));
        return 0;
    }
    if (std::strcmp(given[2], "part") == 0) {
        std::printf("%.17g\n", Impact(springs, std::atof(given[3]), true).held(1e9, 0.0));
        return 0;
    }
    if (std::strcmp(given[2], "stiff") == 0) {
        Impact impact(springs, 0.0);
        impact.lammps.update.dt = std::atof(given[3]);
        for (int i = 0; i < 2; ++i) impact.held(0.0, 0.0);
        for (const std::string &line : impact.lammps.error.said) std::puts(line.c_str());
        return 0;
    }
    const double cohesion = std::atof(given[4]);
    for (char **psi = given + 5; *psi; ++psi) {
        Impact impact(springs, cohesion);
        std::printf("%.17g\n", impact.rebound(std::atof(*psi), std::atoi(given[2]),
                                              std::atoi(given[3])));
    }
} catch (const std::exception &error) {
    std::puts(error.what());
}
